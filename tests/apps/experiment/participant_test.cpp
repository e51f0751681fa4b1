// The screens of a participant: instruction in their language while a phase lasts, the question after it.
#include "apps/experiment/participant.h"

#include <gtest/gtest.h>

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
  experiment.sees.question = false;
  EXPECT_EQ(screenAfter(experiment, "en", true), black);
}

}  // namespace
}  // namespace presa::experiment
