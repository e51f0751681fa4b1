// Ownership of a shared finger, tick by tick.
#include "apps/temple/shared_finger.h"

#include <gtest/gtest.h>

namespace presa::temple {
namespace {

constexpr double kPeriod = 1e-3;

/// Keeps the given position and records the calls.
struct Puppet {
  Vec3 p_WH = Vec3::Zero();
  Vec3 force = Vec3::Zero();
  Tick last = {};
};

class PuppetDevice final : public Device {
 public:
  explicit PuppetDevice(Puppet& puppet) : puppet_(puppet) {}
  FingerInput read(const Tick& tick) noexcept override {
    puppet_.last = tick;
    return {.p_WH = puppet_.p_WH, .v_WH = Vec3::Zero(), .valid = true};
  }
  void write(const Wrench& F_H_W, const Tick&) noexcept override { puppet_.force = F_H_W.f; }
  bool points() const override { return true; }
  void point(const PointerState& pointer, const Tick&) noexcept override { puppet_.p_WH = pointer.p_WT; }

 private:
  Puppet& puppet_;
};

class SharedFingerTest : public testing::Test {
 protected:
  FingerInput tick() {
    Tick tick{.index = index_, .time = static_cast<double>(index_) * kPeriod, .period = kPeriod};
    ++index_;
    finger.see(objects, tick);
    const FingerInput input = finger.read(tick);
    finger.write(Vec3(0, 0, 1), tick);
    return input;
  }
  /// Number of ticks without a valid sample from now on.
  int gone() {
    int ticks = 0;
    for (; !tick().valid; ++ticks) EXPECT_LT(ticks, 10000);
    return ticks;
  }

  Puppet visitor{.p_WH = {1, 0, 0}}, hand{.p_WH = {2, 0, 0}};
  SharedFinger finger{std::make_unique<PuppetDevice>(visitor)};
  ObjectState objects;
  std::uint64_t index_ = 0;
};

TEST_F(SharedFingerTest, IsTheVisitorsUntilItIsGiven) {
  EXPECT_EQ(tick().p_WH.x(), 1);
  EXPECT_EQ(visitor.force.z(), 1);
}

TEST_F(SharedFingerTest, IsGoneForAPauseAndThenTheHands) {
  for (int i = 0; i < 500; ++i) tick();
  finger.give(std::make_unique<PuppetDevice>(hand));
  EXPECT_NEAR(gone() * kPeriod, SharedFinger::kPause, 2 * kPeriod);
  EXPECT_EQ(tick().p_WH.x(), 2);
  EXPECT_EQ(visitor.force.norm(), 0) << "the device on the desk rests meanwhile";
  EXPECT_EQ(hand.force.z(), 1);
  EXPECT_NEAR(hand.last.time, SharedFinger::kPause, 3 * kPeriod) << "its time began when it got the finger";
  EXPECT_NEAR(static_cast<double>(hand.last.index) * kPeriod, hand.last.time, 1e-9);

  finger.give(nullptr);
  EXPECT_NEAR(gone() * kPeriod, SharedFinger::kPause, 2 * kPeriod);
  EXPECT_EQ(tick().p_WH.x(), 1);
  EXPECT_EQ(visitor.force.z(), 1);
}

// Mouse motion while the hands move the finger counts as a visitor.
TEST_F(SharedFingerTest, ThePointerIsTheVisitors) {
  ASSERT_TRUE(finger.points());
  finger.give(std::make_unique<PuppetDevice>(hand));
  tick();
  PointerState pointer;
  pointer.p_WT = {5, 0, 0};
  finger.point(pointer, {});
  tick();
  EXPECT_EQ(hand.p_WH.x(), 2);
  EXPECT_EQ(visitor.p_WH.x(), 5);
  EXPECT_TRUE(finger.visitorMoved());
}

TEST_F(SharedFingerTest, AVisitorWhoMovesTheDeviceIsNoticed) {
  finger.give(std::make_unique<PuppetDevice>(hand));
  tick();
  visitor.p_WH.x() += 0.9 * SharedFinger::kMoves;
  tick();
  EXPECT_FALSE(finger.visitorMoved()) << "it sinks a little by itself";
  visitor.p_WH.x() += 0.2 * SharedFinger::kMoves;
  tick();
  EXPECT_TRUE(finger.visitorMoved());
  finger.give(nullptr);
  EXPECT_FALSE(finger.visitorMoved());
}

}  // namespace
}  // namespace presa::temple
