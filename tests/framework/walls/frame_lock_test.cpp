#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "framework/walls/wall_follower.h"
#include "framework/walls/wall_leader.h"

namespace presa::walls {
namespace {

using testing::ElementsAre;

constexpr std::int64_t kMs = 1'000'000;
const Pose kHead{{0.1, -0.8, 1.7}, Quat::Identity()};

struct Lock : testing::Test {
  WallLeader leader{99};
  WallFollower front{1, "front", kHead}, left{2, "left", kHead};
  std::int64_t now = 1000 * kMs;

  void announce(double time) { last = leader.next(7, time, kHead, true, now); }
  void greet() {
    for (WallFollower* wall : {&front, &left})
      if (const bus::WallDrawn* answer = wall->again(now)) leader.hear(*answer, now);
  }
  void draw(WallFollower& wall, std::uint64_t state = 5) { leader.hear(wall.drawn(state, now), now); }
  bus::WallFrame last;
};

TEST_F(Lock, TheNextFrameWaitsForEveryWall) {
  greet();
  EXPECT_TRUE(leader.ready(now));
  announce(0.5);
  for (WallFollower* wall : {&front, &left}) wall->hear(last, now);
  ASSERT_NE(front.due(), nullptr);
  EXPECT_EQ(front.due()->time, 0.5);
  EXPECT_FALSE(leader.ready(now));
  draw(front);
  EXPECT_EQ(front.due(), nullptr);
  EXPECT_FALSE(leader.ready(now));
  draw(left);
  EXPECT_TRUE(leader.ready(now));
  EXPECT_THAT(leader.present(), ElementsAre("front", "left"));
  EXPECT_EQ(leader.differing(), 0u);
}

TEST_F(Lock, DifferentStatesOfOneFrameAreCountedOnce) {
  greet();
  announce(0.5);
  for (WallFollower* wall : {&front, &left}) wall->hear(last, now);
  draw(front, 5);
  draw(left, 6);
  EXPECT_EQ(leader.differing(), 1u);
}

TEST_F(Lock, ALostMessageIsRepeated) {
  greet();
  announce(0.5);
  front.hear(last, now);
  draw(front);
  EXPECT_EQ(leader.again(now), nullptr);
  now += WallLeader::kRepeat;
  const bus::WallFrame* repeated = leader.again(now);
  ASSERT_NE(repeated, nullptr);
  left.hear(*repeated, now);
  front.hear(*repeated, now);
  EXPECT_EQ(front.due(), nullptr);  // drawn already
  left.drawn(5, now);               // this answer is lost
  EXPECT_FALSE(leader.ready(now));
  now += WallFollower::kGreeting;
  greet();
  EXPECT_TRUE(leader.ready(now));
}

TEST_F(Lock, AWallThatFallsSilentIsLeftBehindUntilItSpeaks) {
  greet();
  announce(0.5);
  front.hear(last, now);
  draw(front);
  now += WallLeader::kPatience + 1;
  draw(front);
  EXPECT_TRUE(leader.ready(now));
  EXPECT_EQ(leader.leftBehind(), 1u);
  EXPECT_THAT(leader.present(), ElementsAre("front"));
  greet();  // left is back, and has not drawn the frame
  EXPECT_FALSE(leader.ready(now));
  left.hear(last, now);
  draw(left);
  EXPECT_TRUE(leader.ready(now));
}

TEST_F(Lock, AWallThatSpeaksButDoesNotDrawIsLeftBehindUntilItDraws) {
  greet();
  announce(0.5);
  front.hear(last, now);
  draw(front);
  now += WallLeader::kPatience + 1;
  greet();  // front repeats its answer, left its greeting
  EXPECT_TRUE(leader.ready(now));
  EXPECT_EQ(leader.leftBehind(), 1u);
  EXPECT_THAT(leader.present(), ElementsAre("front"));
  now += WallFollower::kGreeting;
  greet();
  EXPECT_TRUE(leader.ready(now));  // a greeting is no frame
  left.hear(last, now);
  draw(left);
  EXPECT_THAT(leader.present(), ElementsAre("front", "left"));
  announce(0.6);
  front.hear(last, now);
  draw(front);
  EXPECT_FALSE(leader.ready(now));  // left is waited for again
}

TEST_F(Lock, AWallThatJoinsLateHasItsTimeToDraw) {
  announce(0.5);
  now += WallLeader::kPatience + 1;
  greet();
  EXPECT_FALSE(leader.ready(now));
  EXPECT_EQ(leader.leftBehind(), 0u);
}

TEST_F(Lock, WallsThatHaveEndedLeaveTheirPlaces) {
  const auto greetAs = [&](std::uint64_t sender) {
    WallFollower wall(sender, "floor", kHead);
    return leader.hear(*wall.again(now), now);
  };
  for (std::uint64_t sender = 1; sender <= WallLeader::kMost; ++sender) EXPECT_TRUE(greetAs(sender));
  EXPECT_FALSE(greetAs(1000));
  now += WallLeader::kPatience + 1;
  EXPECT_TRUE(greetAs(7));
  EXPECT_TRUE(leader.ready(now));  // and leaves all others behind
  EXPECT_TRUE(greetAs(1000));
  EXPECT_EQ(leader.present().size(), 2u);
}

TEST_F(Lock, AWallFollowsOneLeaderUntilItIsLost) {
  announce(0.5);
  front.hear(last, now);
  bus::WallFrame other = last;
  other.leader = 98;
  other.time = 0.9;
  front.hear(other, now);
  EXPECT_EQ(front.frame().time, 0.5);
  EXPECT_FALSE(front.leaderLost(now));
  now += WallFollower::kSilence + 1;
  EXPECT_TRUE(front.leaderLost(now));
  front.hear(other, now);
  EXPECT_FALSE(front.leaderLost(now));
  EXPECT_EQ(front.due()->time, 0.9);
}

TEST_F(Lock, DamagedFramesAreIgnored) {
  announce(0.5);
  bus::WallFrame bad = last;
  bad.time = std::nan("");
  front.hear(bad, now);
  bad = last;
  bad.X_KHead.p.z() = INFINITY;
  front.hear(bad, now);
  bad = last;
  bad.X_KHead.q.coeffs() *= 1.1;
  front.hear(bad, now);
  EXPECT_FALSE(front.led());
  bus::WallDrawn forged = front.drawn(5, now);
  forged.leader = 99;
  forged.number = 1000;  // never announced
  leader.hear(forged, now);
  EXPECT_TRUE(leader.present().empty());
}

TEST_F(Lock, DamagedAnswersAreIgnored) {
  announce(0.5);
  front.hear(last, now);
  const bus::WallDrawn good = front.drawn(5, now);
  bus::WallDrawn bad = good;
  bad.X_KHead.p.x() = std::nan("");
  EXPECT_FALSE(leader.hear(bad, now));
  bad = good;
  bad.X_KHead.q.coeffs().setZero();
  EXPECT_FALSE(leader.hear(bad, now));
  bad = good;
  bad.time = INFINITY;
  EXPECT_FALSE(leader.hear(bad, now));
  EXPECT_TRUE(leader.present().empty());
  EXPECT_TRUE(leader.hear(good, now));
}

TEST_F(Lock, NoHeadThatWallsIgnoreIsAnnounced) {
  announce(0.5);
  Pose bad = kHead;
  bad.p.z() = std::nan("");
  last = leader.next(7, 0.6, bad, true, now);
  EXPECT_EQ(last.X_KHead.p, kHead.p);
  EXPECT_FALSE(last.tracked);
  front.hear(last, now);
  ASSERT_NE(front.due(), nullptr);
  EXPECT_EQ(front.due()->time, 0.6);
}

// Whatever is lost, and whatever order the processes run in: no wall shows frame n + 1 before all have shown frame n.
TEST_F(Lock, WallsAreNeverMoreThanOneFrameApart) {
  std::mt19937 random(25);
  std::uint64_t shown_by_front = 0, shown_by_left = 0;
  for (int step = 0; step < 20'000; ++step, now += kMs) {
    const bool lost = random() % 4 == 0;
    if (WallFollower& wall = random() % 2 == 0 ? front : left; random() % 3 == 0 && wall.due() != nullptr) {
      (&wall == &front ? shown_by_front : shown_by_left) = wall.due()->number;
      const bus::WallDrawn answer = wall.drawn(wall.due()->number, now);
      if (!lost) leader.hear(answer, now);
    }
    if (!lost) greet();
    const bool both = leader.present().size() == 2;
    const bus::WallFrame* frame = nullptr;
    if (both && leader.ready(now))
      frame = &leader.next(7, 1e-3 * step, kHead, true, now);
    else
      frame = leader.again(now);
    if (frame != nullptr && !lost) (random() % 2 == 0 ? front : left).hear(*frame, now);
    const auto [low, high] = std::minmax(shown_by_front, shown_by_left);
    ASSERT_LE(high - low, 1u);
  }
  EXPECT_GT(shown_by_front, 50u);  // the walls got on
  EXPECT_EQ(leader.leftBehind(), 0u);
}

}  // namespace
}  // namespace presa::walls
