// The stylus alone, and as a device of the shipped rig.
#include "devices/pointer/stylus.h"

#include <gtest/gtest.h>

#include <cmath>

#include "framework/device/device_plugin.h"
#include "tests/apps/support/support.h"
#include "tests/support/alloc_lock_guard.h"

namespace presa::pointer {
namespace {

constexpr double kTick = 1e-3;
const FingerImpedance kPen{.mass = 0.1, .stiffness = 300, .damping = 8};

struct StylusBench {
  void run(double seconds, const Wrench& wrench = {}) {
    for (int i = 0; i < std::lround(seconds / kTick); ++i) {
      ++at;
      stylus.advance({at, static_cast<double>(at) * kTick, kTick});
      const Quat before = last;
      last = stylus.sample().q_WT;
      fastest = std::max(fastest, last.angularDistance(before) / kTick);
      stylus.push(wrench);
    }
  }
  Stylus stylus{Vec3(0, 0, 0.1), 10, kPen, kTick};
  std::uint64_t at = 0;
  Quat last = Quat::Identity();
  double fastest = 0;
};

// Axis of the pen for yaw y and tilt t: (sin t cos y, sin t sin y, cos t). The followers are at rest after a second; both
// together turn by at most sqrt(2) of one follower's speed.
TEST(PointerStylus, LeansWhereThePointerSays) {
  StylusBench bench;
  bench.stylus.point({1, Vec3(0, 0, 0.1), 0.7, 0, 0.5, 0, {}});
  bench.run(2);
  const Vec3 axis = bench.stylus.sample().q_WT * Vec3::UnitZ();
  EXPECT_LT((axis - Vec3(std::sin(0.5) * std::cos(0.7), std::sin(0.5) * std::sin(0.7), std::cos(0.5))).norm(), 1e-6);
  EXPECT_LE(bench.fastest, std::sqrt(2) * Stylus::kTurn);
  EXPECT_GT(bench.fastest, 1);
}

// Key p of the window is one of its buttons, which a tool may be put down by.
TEST(PointerStylus, HasTheButtonsThatAreHeld) {
  StylusBench bench;
  PointerState pointer;
  pointer.sequence = 1;
  pointer.p_WT = {0, 0, 0.1};
  pointer.buttons = 1U << kPickUpButton;
  bench.stylus.point(pointer);
  EXPECT_EQ(bench.stylus.sample().buttons, 2U);
  pointer.buttons = 0;
  bench.stylus.point(pointer);
  EXPECT_EQ(bench.stylus.sample().buttons, 0U);
}

// The reported angular velocity is the rate of the reported orientation, also about two axes at once.
TEST(PointerStylus, ReportsTheRateOfItsOrientation) {
  StylusBench bench;
  bench.stylus.point({1, Vec3(0, 0, 0.1), 1.2, 0, 0.8, 0, {}});
  bench.run(0.2);
  const FingerInput before = bench.stylus.sample();
  bench.run(kTick);
  const FingerInput after = bench.stylus.sample();
  const Eigen::AngleAxisd turn(after.q_WT * before.q_WT.conjugate());
  // first order in the period: half a millisecond of an angular acceleration of 60 rad/s^2
  EXPECT_LT((turn.angle() / kTick * turn.axis() - after.w_WT).norm(), 0.05);
  EXPECT_GT(after.w_WT.norm(), 1);
}

// A torque turns it as far as the hand's rotational spring of 0.3 N m/rad yields; a force moves its tip on 300 N/m.
TEST(PointerStylus, YieldsToForceAndTorque) {
  StylusBench bench;
  bench.run(2, {Vec3(0, 0, 3), Vec3(0.03, 0, 0)});
  const FingerInput sample = bench.stylus.sample();
  EXPECT_NEAR(sample.p_WH.z(), 0.11, 1e-6);
  EXPECT_NEAR(2 * std::asin(sample.q_WT.x()), 0.1, 1e-6);
}

TEST(PointerStylus, IgnoresATargetThatIsNotFinite) {
  StylusBench bench;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  bench.stylus.point({1, Vec3(0, 0, 0.1), nan, 0, nan, 0, {}});
  bench.run(0.1);
  EXPECT_LT(bench.stylus.sample().q_WT.angularDistance(Quat::Identity()), 1e-12);
}

TEST(PointerStylus, NeitherAllocatesNorLocks) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  StylusBench bench;
  const RealTimeGuard guard;
  bench.stylus.point({1, Vec3(0, 0, 0.1), 1, 0, 1, 0, {}});
  bench.run(0.1);
  EXPECT_EQ(guard.violations(), 0) << guard.first();
}

TEST(PointerStylus, IsADeviceOfTheShippedRig) {
  const test::Outcome check = test::presa("check " + test::source("config/scenes/stylus_on_cube.xml") + " --rig " +
                                          test::source("config/rigs/pointer_stylus.xml"));
  EXPECT_EQ(check.status, 0) << check.out << check.err;
  EXPECT_EQ(test::presa("check " + test::source("config/scenes/stylus_on_cube.xml")).status, 0);
}

TEST(PointerStylus, MistakesAreNamed) {
  auto world = std::make_shared<World>();
  world->scene.devices.resize(2);
  const auto made = [&](const std::vector<std::string>& tools) {
    std::vector<DeviceBinding> bindings;
    for (const std::string& tool : tools) {
      bindings.emplace_back().role = "r" + std::to_string(bindings.size());
      bindings.back().settings["tool"].value = tool;
    }
    Diagnostics diagnostics;
    devicePlugin("pointer").create(bindings, world, {}, diagnostics);
    return diagnostics.text();
  };
  EXPECT_NE(made({"pen"}).find("error[E457]: tool must be finger or stylus, found 'pen'"), std::string::npos)
      << made({"pen"});
  EXPECT_NE(made({"stylus", "finger"}).find("error[E458]"), std::string::npos) << made({"stylus", "finger"});
  EXPECT_EQ(made({"stylus"}), "");
}

}  // namespace
}  // namespace presa::pointer
