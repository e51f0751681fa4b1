// The screens of a participant: instruction in their language while a phase lasts, the question after it.
#include "apps/experiment/participant.h"

#include <gtest/gtest.h>

#include <functional>

#include "apps/experiment/operator/keyed_operator.h"

namespace presa::experiment {
namespace {

Experiment twoPhases() {
  Experiment experiment;
  experiment.phases.resize(2);
  experiment.phases[0].name = "hold";
  experiment.phases[1].name = "look";
  experiment.phases[1].sees = {.bodies = false, .fingertips = false, .instruction = false, .fixation = true};
  experiment.texts = {
      {"hold", "en", "Hold it."}, {"hold", "it", "Tenetelo."}, {"look", "en", "Look."}, {"question", "it", "Quale?"}};
  return experiment;
}

TEST(ParticipantScreens, FollowThePhase) {
  const Experiment experiment = twoPhases();
  EXPECT_EQ(screenIn(experiment, experiment.phases[0], "it"), (ParticipantScreen{.text = "Tenetelo."}));
  EXPECT_EQ(screenIn(experiment, experiment.phases[1], "en"),
            (ParticipantScreen{.bodies = false, .fingertips = false, .fixation = true}));
}

TEST(ParticipantScreens, AskWhenThePresentationIsOver) {
  Experiment experiment = twoPhases();
  const ParticipantScreen black{.bodies = false, .fingertips = false};
  ParticipantScreen question = black;
  question.text = "Quale?";
  EXPECT_EQ(screenAfter(experiment, "en", true), question) << "the first language where the asked one is missing";
  EXPECT_EQ(screenAfter(experiment, "en", false), black);
  experiment.texts.push_back({"answers", "en", "left: 1, right: 2"});
  question.text = "Quale?\nleft: 1, right: 2";
  EXPECT_EQ(screenAfter(experiment, "en", true), question);
  experiment.sees.answers = false;
  experiment.sees.question = false;
  EXPECT_EQ(screenAfter(experiment, "en", true), black);
}

/// An operator's display at which somebody types these keys, one a call.
class TypedFace final : public Face {
 public:
  explicit TypedFace(std::string keys) : keys_(std::move(keys)) {}
  void draw(const ConsoleView&) override {}
  char key(int) override { return next_ < keys_.size() ? keys_[next_++] : 0; }
  std::size_t columns() const override { return 80; }
  std::size_t rows() const override { return 24; }

 private:
  std::string keys_;
  std::size_t next_ = 0;
};

/// A participant who types these keys.
std::function<char()> typing(std::string keys) {
  return [keys, next = std::size_t{0}]() mutable { return next < keys.size() ? keys[next++] : '\0'; };
}

TEST(ParticipantsAnswer, CountsAsTheOperatorsAndStopsNothing) {
  const auto person = keyedOperator(std::make_unique<TypedFace>(std::string(3, '\0')));
  person->listenTo(typing("qx2"));
  EXPECT_EQ(person->ask("Which?"), 2) << "neither q nor x is an answer, and q is the operator's to press";
  person->listenTo(typing("q1."));
  EXPECT_EQ(person->askAdjust("More?"), psychophysics::AdjustmentKey::kUpFine);
  person->listenTo({});
  const auto other = keyedOperator(std::make_unique<TypedFace>("1"));
  other->listenTo(typing("   "));
  EXPECT_EQ(other->ask("Which?"), 1);
}

TEST(ParticipantsAnswer, DoesNotEndARest) {
  const auto person = keyedOperator(std::make_unique<TypedFace>("nq\nq"));
  int asked = 0;
  person->listenTo([&asked] { return ++asked < 100 ? ' ' : '\0'; });
  EXPECT_EQ(person->await("rest", 0), Operator::Request::kStop) << "the note is the operator's, and so is the stop";
  EXPECT_EQ(person->takeNote(), "q");
  EXPECT_GT(asked, 2);
}

}  // namespace
}  // namespace presa::experiment
