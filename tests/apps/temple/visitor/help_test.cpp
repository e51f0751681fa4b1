// The help with grasping: what it does to the pointer's target, and that it does nothing else.
#include "apps/temple/help/grasp_help.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "apps/common/scratch_folder.h"
#include "apps/temple/help/helped_finger.h"
#include "tests/apps/temple/visitor/first_task.h"
#include "tests/support/alloc_lock_guard.h"

namespace presa::temple {
namespace {

constexpr double kPeriod = 1e-3, kNotch = 0.04, kOpenHalf = 0.068;

/// The help on the first task, with fingertips that are at once where the help wants them.
class GraspHelpTest : public testing::Test {
 protected:
  GraspHelpTest() : world(test::loadFirstTask(3, scratch.path().string(), {}).world), help(world) {
    for (std::size_t i = 0; i < world->scene.bodies.size(); ++i) {
      if (world->scene.bodies[i].name == "capital") capital = i;
      X_WB.push_back(world->scene.bodies[i].X_WB);
    }
    pointer.sequence = 1;
  }
  PointerState run(double seconds) {
    PointerState helped;
    for (const double end = time + seconds; time < end; time += kPeriod) {
      ++index;
      helped = help.target(pointer, {index, time, kPeriod});
      const double half = std::max(0.0, kOpenHalf - helped.closing * (kOpenHalf + 0.02));
      const Vec3 along(std::cos(helped.yaw), std::sin(helped.yaw), 0);
      help.noteFinger(0, helped.p_WT - half * along);
      help.noteFinger(1, helped.p_WT + half * along);
    }
    return helped;
  }
  void scroll(int notches) {
    pointer.wheel += notches * kNotch;
    pointer.closing = std::clamp(pointer.closing + notches * kNotch, 0.0, 1.0);
    ++pointer.sequence;
  }
  const Vec3& block() const { return X_WB[capital].p; }

  ScratchFolder scratch;
  std::shared_ptr<const World> world;
  GraspHelp help;
  PointerState pointer;
  std::vector<Pose> X_WB;
  std::size_t capital = 0;
  double time = 0;
  std::uint64_t index = 0;
};

TEST_F(GraspHelpTest, OverABlockThePairComesToItsMiddleAndTurnsAcrossItsFaces) {
  pointer.p_WT = block() + Vec3(0.02, -0.015, 0.1);
  pointer.yaw = 0.3;
  const PointerState helped = run(0.5);
  EXPECT_LT((helped.p_WT - block()).head<2>().norm(), 1e-9);
  // the abacus is square: the nearest of its four sides
  const Vec3 side = X_WB[capital].q * Vec3::UnitX();
  const double off = std::remainder(helped.yaw - std::atan2(side.y(), side.x()), std::numbers::pi / 2);
  EXPECT_NEAR(off, 0, 1e-9);
  EXPECT_LE(std::abs(helped.yaw - pointer.yaw), std::numbers::pi / 4 + 1e-9);
  EXPECT_LT(helped.p_WT.z(), block().z() + 0.012) << "down between its faces";
  EXPECT_EQ(helped.closing, 0);
}

TEST_F(GraspHelpTest, ANotchIsNoGripTwoAre) {
  pointer.p_WT = block() + Vec3(0.02, 0, 0.1);
  run(0.5);
  scroll(1);
  EXPECT_EQ(run(0.1).closing, 0);
  scroll(1);
  EXPECT_GT(run(0.1).closing, 0.8);
}

TEST_F(GraspHelpTest, FarFromEveryBlockThePointerMovesThePair) {
  pointer.p_WT = {0.3, 0.3, 0.2};
  pointer.yaw = 0.7;
  scroll(3);
  const PointerState helped = run(0.1);
  EXPECT_EQ(helped.p_WT, pointer.p_WT);
  EXPECT_EQ(helped.yaw, pointer.yaw);
  EXPECT_NEAR(helped.closing, pointer.closing, 1e-12);
}

TEST_F(GraspHelpTest, WithoutStrengthOrActivityNothingIsHelped) {
  pointer.p_WT = block() + Vec3(0.01, 0, 0.01);
  scroll(5);
  for (const bool active : {true, false}) {
    help.setStrength(active ? 0 : 1);
    help.setActive(active);
    const PointerState helped = run(0.3);
    EXPECT_EQ(helped.p_WT, pointer.p_WT);
    EXPECT_EQ(helped.yaw, pointer.yaw);
    EXPECT_NEAR(helped.closing, pointer.closing, 1e-12);
  }
}

TEST_F(GraspHelpTest, WeakerItBeginsNearer) {
  pointer.p_WT = block() + Vec3(0.03, 0, 0.1);
  help.setStrength(0.5);
  EXPECT_EQ(run(0.3).p_WT.x(), pointer.p_WT.x());
  pointer.p_WT = block() + Vec3(0.02, 0, 0.1);
  EXPECT_NEAR(run(0.3).p_WT.x(), block().x(), 1e-9);
}

TEST_F(GraspHelpTest, NeitherAllocatesNorLocks) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  const RealTimeGuard guard;
  for (const double x : {-0.14, 0.0, 0.14}) {
    pointer.p_WT = {x, -0.03, 0.1};
    scroll(3);
    run(0.5);
  }
  EXPECT_EQ(guard.violations(), 0) << guard.first();
}

/// Records what it is told.
struct Felt {
  Vec3 force = Vec3::Zero();
};
class RecordingDevice final : public Device {
 public:
  RecordingDevice(Felt& felt, bool pointed) : felt_(felt), pointed_(pointed) {}
  FingerInput read(const Tick&) noexcept override { return {.valid = true}; }
  void write(const Wrench& F_H_W, const Tick&) noexcept override { felt_.force = F_H_W.f; }
  bool points() const override { return pointed_; }

 private:
  Felt& felt_;
  bool pointed_;
};

TEST_F(GraspHelpTest, ForcesPassUnchangedAndFeltDevicesAreNotTouched) {
  const auto shared = std::make_shared<GraspHelp>(world);
  std::array<Felt, 2> felt;
  for (const bool pointed : {true, false}) {
    DeviceList devices;
    for (Felt& one : felt) devices.push_back(std::make_unique<RecordingDevice>(one, pointed));
    const Device* const before = devices[0].get();
    devices = helped(std::move(devices), shared);
    EXPECT_EQ(devices[0].get() == before, !pointed);
    const Vec3 force(0.1, -2.7, 1e-9);
    devices[1]->write(force, {});
    EXPECT_EQ(felt[1].force, force);
  }
}

}  // namespace
}  // namespace presa::temple
