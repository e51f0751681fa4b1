#include "framework/assembly/assembly_guide.h"

#include <gmock/gmock.h>

#include "framework/assembly/captions.h"
#include "framework/assembly/standing.h"

namespace presa {
namespace {

using Kind = GuideEvent::Kind;
using Status = GoalState::Status;

constexpr double kPeriod = 0.01;  // [s]

/// Two interchangeable drums and a capital: base, shaft on it, head on top. Times below are counted in steps of
/// kPeriod.
class GuideTest : public testing::Test {
 protected:
  GuideTest() {
    for (const char* name : {"drum_a", "drum_b", "capital", "ground"}) scene_.bodies.emplace_back().name = name;
    Assembly assembly;
    assembly.words.elements = {{"drum", "Drum", "It is round.", "A drum needs the one below.", {}},
                               {"capital", "Capital", "It is wide.", "The capital needs its drum first.", {}}};
    assembly.goals = {{.name = "base", .bodies = {0, 1}, .X_WB = at(0, 0.03), .after = {}, .element = 0},
                      {.name = "shaft", .bodies = {0, 1}, .X_WB = at(0, 0.09), .after = {0}, .element = 0},
                      {.name = "head", .bodies = {2}, .X_WB = at(0, 0.14), .after = {1}, .element = 1}};
    scene_.assembly = assembly;
    state_.goals.resize(3);
    objects_.bodies.resize(4);
    contacts_ = ContactExchange(2);
    place(0, 0.2, 0.03);
    place(1, 0.3, 0.03);
    place(2, 0.4, 0.03);
    guide_.emplace(*scene_.assembly, scene_.bodies.size());
  }

  static Pose at(double x, double z) { return {{x, 0, z}, Quat::Identity()}; }
  void place(std::size_t body, double x, double z) { objects_.bodies[body].X_WB_end = at(x, z); }

  /// Both fingers touch a body; kNoBody: none.
  void hold(std::int32_t body, int fingers = 2) {
    for (int f = 0; f < 2; ++f) {
      FingerContact& finger = contacts_.fingers[static_cast<std::size_t>(f)];
      const bool on = body != kNoBody && f < fingers;
      finger = {.mode = on ? ContactMode::kStick : ContactMode::kNone, .body = on ? body : kNoBody};
      finger.normal_force = on ? 2 : 0;
    }
  }
  void fill(std::size_t goal, std::int32_t body) {
    state_.goals[goal] = {Status::kFilled, body, kNoGoal};
    objects_.bodies[static_cast<std::size_t>(body)].X_WB_end = scene_.assembly->goals[goal].X_WB;
  }

  void step() {
    time_ += kPeriod;
    guide_->step(time_, objects_, state_, contacts_);
    for (const GuideEvent& event : guide_->events()) kinds_.push_back(event.kind);
  }
  void run(double seconds) {
    for (int i = 0; i < static_cast<int>(std::lround(seconds / kPeriod)); ++i) step();
  }
  Captions captions() const { return captionsOf(scene_, guide_->now()); }

  Scene scene_;
  ObjectState objects_;
  AssemblyState state_;
  ContactExchange contacts_;
  std::optional<AssemblyGuide> guide_;
  double time_ = 0;
  std::vector<Kind> kinds_;
};

TEST_F(GuideTest, NamesWhatIsTouchedAndForgetsItAfterAWhile) {
  step();
  EXPECT_EQ(captions().title, "");
  EXPECT_EQ(captions().progress, "0 of 3");
  hold(2, 1);
  step();
  EXPECT_EQ(captions().title, "Capital");
  EXPECT_EQ(captions().sentence, "It is wide.");
  EXPECT_FALSE(guide_->now().held);
  hold(kNoBody);
  run(AssemblyGuide::kLinger - kPeriod);
  EXPECT_EQ(captions().title, "Capital");
  run(3 * kPeriod);
  EXPECT_EQ(captions().title, "");
  hold(3);  // the ground has no caption
  step();
  EXPECT_EQ(captions().title, "");
}

// Each body taken tells the next sentence about its kind; while the news of a placed one is shown, its own stays.
TEST_F(GuideTest, TellsTheStoriesInTurn) {
  AssemblyWords::Element& kind = scene_.assembly->words.elements[scene_.assembly->goals[2].element];
  kind.stories = {{"It is old.", "a book"}, {"It is heavy.", "another"}};
  Guidance guidance = guide_->now();
  guidance.body = 2;
  const std::vector<std::string> in_turn{"It is wide.", "It is old.", "It is heavy.", "It is wide."};
  for (int placed = 0; placed < 4; ++placed) {
    guidance.placed = placed;
    EXPECT_EQ(captionsOf(scene_, guidance).sentence, in_turn[static_cast<std::size_t>(placed)]);
  }
  guidance.news = GuideEvent{.kind = Kind::kPlaced, .goal = 2, .body = 2};
  guidance.body = kNoBody;
  EXPECT_EQ(captionsOf(scene_, guidance).sentence, "It is heavy.");
}

TEST_F(GuideTest, SaysWhyABlockHasToWait) {
  hold(2);
  step();
  EXPECT_EQ(guide_->now().missing, 1);
  EXPECT_EQ(guide_->now().goal, kNoGoal);
  EXPECT_EQ(captions().reason, "The capital needs its drum first.");
  EXPECT_THAT(kinds_, testing::ElementsAre(Kind::kTaken));  // no attempt yet
  state_.goals[2] = {Status::kBlocked, 2, 1};
  run(0.5);
  EXPECT_THAT(kinds_, testing::ElementsAre(Kind::kTaken, Kind::kBlocked));  // one attempt
  hold(0);
  state_.goals[2] = {};
  step();
  EXPECT_EQ(guide_->now().goal, 0);
  EXPECT_EQ(captions().reason, "");
}

TEST_F(GuideTest, HintsAtWhatComesNextAfterHesitation) {
  run(AssemblyGuide::kHesitation - kPeriod);
  EXPECT_EQ(guide_->now().hint_goal, kNoGoal);
  run(2 * kPeriod);
  EXPECT_EQ(guide_->now().hint_goal, 0);
  EXPECT_EQ(guide_->now().hint_body, 0) << "the nearer of both drums";
  EXPECT_EQ(captions().hint, "Next: Drum");
  // with the other drum in hand, the hint is for that drum
  hold(1);
  step();
  EXPECT_EQ(guide_->now().hint_body, 1);
  fill(0, 1);
  step();
  EXPECT_EQ(guide_->now().hint_goal, kNoGoal);
  EXPECT_THAT(kinds_, testing::ElementsAre(Kind::kHint, Kind::kTaken, Kind::kPlaced));
  hold(kNoBody);
  run(AssemblyGuide::kHesitation + kPeriod);
  EXPECT_EQ(guide_->now().hint_goal, 1);
  EXPECT_EQ(guide_->now().hint_body, 0);
}

TEST_F(GuideTest, TellsWhatWasPlacedAndTakenOut) {
  hold(0);
  step();
  fill(0, 0);
  step();
  EXPECT_EQ(captions().news, "Placed: Drum");
  EXPECT_TRUE(captions().good);
  EXPECT_EQ(captions().progress, "1 of 3");
  hold(kNoBody);
  run(AssemblyGuide::kNews + 2 * kPeriod);
  EXPECT_EQ(captions().news, "");
  state_.goals[0] = {};
  step();
  EXPECT_EQ(captions().news, "Taken out: Drum");
  EXPECT_FALSE(captions().good);
  EXPECT_THAT(kinds_, testing::ElementsAre(Kind::kTaken, Kind::kPlaced, Kind::kUndone));
}

TEST_F(GuideTest, ADropIsAFallFromTheHand) {
  objects_.bodies[0].v_WB.z() = -1;
  run(0.1);
  EXPECT_TRUE(kinds_.empty()) << "it falls, and nobody had it";
  objects_.bodies[0].v_WB.z() = 0;
  hold(0);
  step();
  place(0, 0.2, 0.03 + AssemblyGuide::kLifted + 0.01);
  step();
  hold(kNoBody);
  objects_.bodies[0].v_WB.z() = -1.1 * AssemblyGuide::kFalls;
  run(0.1);
  EXPECT_THAT(kinds_, testing::ElementsAre(Kind::kTaken, Kind::kDropped));
}

TEST_F(GuideTest, TheFinishTellsTheTimeSinceTheFirstTouchAndWhatWasSpentBefore) {
  scene_.assembly->elapsed = 100;
  guide_.emplace(*scene_.assembly, scene_.bodies.size());
  run(5);
  hold(0);
  step();
  fill(0, 0);
  fill(1, 1);
  fill(2, 2);
  run(30);
  EXPECT_TRUE(guide_->now().finished);
  EXPECT_NEAR(guide_->now().elapsed, 100 + kPeriod, 1e-9);
  EXPECT_EQ(captions().finish, "All stands.");
  EXPECT_EQ(captions().took, "In 1 min 40 s.");
  EXPECT_EQ(std::ranges::count(kinds_, Kind::kFinished), 1);
}

TEST_F(GuideTest, WhatStoodAtTheStartWasPlacedByNobody) {
  fill(0, 0);
  fill(1, 1);
  fill(2, 2);
  run(1);
  EXPECT_TRUE(kinds_.empty());
  EXPECT_FALSE(guide_->now().finished);
  EXPECT_EQ(captions().progress, "3 of 3");
}

// As after another guide, which has told all of it: fingers on a body in place are no news, and hesitation begins anew.
TEST_F(GuideTest, WhatStoodWhenItTookOverWasToldBefore) {
  fill(0, 0);
  time_ = state_.time = 100;
  guide_->resume(state_);
  EXPECT_EQ(guide_->now().placed, 1);
  hold(0);
  run(AssemblyGuide::kHesitation - 2 * kPeriod);
  EXPECT_TRUE(kinds_.empty());
  EXPECT_EQ(guide_->now().hint_goal, kNoGoal);
  run(3 * kPeriod);
  EXPECT_THAT(kinds_, testing::ElementsAre(Kind::kHint));
  state_.goals[0] = {};
  step();
  EXPECT_EQ(kinds_.back(), Kind::kUndone);
}

TEST_F(GuideTest, PosesAloneTellWhatStands) {
  place(0, 0, 0.03);
  place(1, 0.01, 0.14);  // not at any drum's goal
  place(2, 0.01, 0.14);
  const AssemblyState seen = standing(*scene_.assembly, objects_);
  EXPECT_EQ(seen.filled, 1);
  EXPECT_EQ(seen.goals[0].status, Status::kFilled);
  EXPECT_EQ(seen.goals[1].status, Status::kOpen);
  EXPECT_EQ(seen.goals[2].status, Status::kBlocked);
  EXPECT_EQ(seen.goals[2].missing, 1);
  objects_.bodies[0].v_WB.x() = 0.1;  // passing through
  EXPECT_EQ(standing(*scene_.assembly, objects_).filled, 0);
}

TEST(CaptionsText, TimesAreInMinutesAndSeconds) {
  EXPECT_EQ(durationText(0.4), "0 s");
  EXPECT_EQ(durationText(59.6), "1 min 0 s");
  EXPECT_EQ(durationText(3605), "60 min 5 s");
}

}  // namespace
}  // namespace presa
