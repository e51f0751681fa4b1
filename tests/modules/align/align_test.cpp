#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "framework/device/device_plugin.h"
#include "framework/record/record_plugin.h"
#include "tests/apps/support/support.h"
#include "tests/support/alloc_lock_guard.h"
#include "tests/support/effect_field.h"

namespace presa {
namespace {

constexpr double kStiffness = 0.05, kDamping = 0.002, kMaxTorque = 0.03;
const std::string kElement = R"(<align max_torque="0.03" stiffness="0.05" damping="0.002"/>)";

FingerInput tool(const Quat& q_WT, const Vec3& w_WT = Vec3::Zero()) {
  FingerInput input;
  input.oriented = true;
  input.q_WT = q_WT;
  input.w_WT = w_WT;
  input.p_WH = {0.1, 0.2, 0.3};
  return input;
}
Quat about(const Vec3& axis, double angle) { return Quat(Eigen::AngleAxisd(angle, axis.normalized())); }

// The couple is the negative slope of stiffness (1 - a . b) for a rotation about any axis. Central differences of step
// 1e-6: 1e-10.
TEST(Align, TorqueIsTheGradientOfItsPotential) {
  test::EffectField field(kElement);
  const auto potential = [](const Quat& q) { return kStiffness * (1 - (q * Vec3::UnitZ()).z()); };
  for (int i = 0; i < 100; ++i) {
    const Quat q = about(Vec3(std::sin(i), std::cos(1.3 * i), std::sin(2.1 * i)), 0.6 * std::sin(0.7 * i));
    const Wrench wrench = field.wrench(tool(q));
    EXPECT_TRUE(wrench.f.isZero(0));
    for (int k = 0; k < 3; ++k) {
      const double slope =
          (potential(about(Vec3::Unit(k), 1e-6) * q) - potential(about(Vec3::Unit(k), -1e-6) * q)) / 2e-6;
      EXPECT_NEAR(wrench.t[k], -slope, 1e-9) << i;
    }
  }
}

TEST(Align, IsBoundedAndDampsOnlyTheTurningOfTheAxis) {
  test::EffectField field(kElement);
  EXPECT_NEAR(field.wrench(tool(about(Vec3::UnitX(), 1.2))).t.norm(), kMaxTorque, 1e-12);
  const Wrench turning = field.wrench(tool(Quat::Identity(), {1, 2, 30}));
  EXPECT_LT((turning.t - Vec3(-kDamping, -2 * kDamping, 0)).norm(), 1e-15);  // the spin about the axis is free
}

// A fingertip that cannot feel a torque gives none to the body.
TEST(Align, LeavesAFingertipWithoutOrientationAlone) {
  test::EffectField field(kElement);
  FingerInput finger = tool(about(Vec3::UnitX(), 1));
  finger.oriented = false;
  EXPECT_TRUE(field.wrench(finger) == Wrench());
  EXPECT_TRUE(field.angularImpulse().isZero(0));
}

TEST(Align, GivesTheBodyTheOppositeCouple) {
  test::EffectField field(kElement);
  const Wrench wrench = field.wrench(tool(about(Vec3::UnitX(), 0.3)));
  EXPECT_NEAR(wrench.t.x(), -kStiffness * std::sin(0.3), 1e-15);
  EXPECT_LT((field.angularImpulse() + 1e-3 * wrench.t).norm(), 1e-18);
  EXPECT_TRUE(field.impulse().isZero(0));
}

TEST(Align, NeitherAllocatesNorLocks) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  test::EffectField field(kElement);
  const RealTimeGuard guard;
  for (int i = 0; i < 100; ++i) field.wrench(tool(about(Vec3::UnitX(), 0.01 * i)));
  EXPECT_EQ(guard.violations(), 0) << guard.first();
}

/// The stylus of the shipped motion, 2.9 s after its start: tilted by 60 degrees and at rest there since 2 s.
double tiltUnderGuide(double stiffness) {
  test::EffectField field("<align max_torque=\"1\" stiffness=\"" + std::to_string(stiffness) + "\"/>");
  auto world = std::make_shared<World>();
  world->scene.devices.resize(1);
  world->scene.devices[0].role = "stylus";
  DeviceBinding binding;
  binding.role = "stylus";
  binding.driver = "scripted";
  binding.settings["motion"].value = test::source("config/motions/stylus.csv");
  Diagnostics diagnostics;
  const DeviceList devices = devicePlugin("scripted").create({binding}, world, {}, diagnostics);
  if (devices.size() != 1 || !devices[0]) throw InputError(diagnostics);
  FingerInput sample;
  for (std::uint64_t i = 0; i < 2900; ++i) {
    const Tick tick{i, 1e-3 * static_cast<double>(i), 1e-3};
    sample = devices[0]->read(tick);
    devices[0]->write({Vec3::Zero(), field.wrench(sample).t}, tick);
  }
  EXPECT_LT(sample.w_WT.norm(), 1e-3);
  return std::acos((sample.q_WT * Vec3::UnitZ()).z());
}

// In balance the hand's rotational spring (0.3 N m/rad) and the guide hold each other: k sin(theta) = 0.3 (60 deg - theta).
TEST(Align, TurnsTheStylusOfAHandAsFarAsItsSpringYields) {
  for (const double stiffness : {0.02, 0.1, 0.5}) {
    double low = 0, high = std::numbers::pi / 3;
    for (int i = 0; i < 60; ++i) {
      const double theta = (low + high) / 2;
      (stiffness * std::sin(theta) < 0.3 * (std::numbers::pi / 3 - theta) ? low : high) = theta;
    }
    // the keyframe has seven digits; the slowest mode decays by exp(-0.9 s * 30/s)
    EXPECT_NEAR(tiltUnderGuide(stiffness), low, 1e-6) << stiffness;
  }
}

class StylusRun : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(run_.status, 0) << run_.err;
    samples_ = recordPlugin().samples(recording_);
    ASSERT_EQ(samples_.tools.size(), 1u);
  }
  const std::string recording_ =
      test::scratch(std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".h5");
  const test::Outcome run_ =
      test::presa("run " + test::source("config/scenes/stylus_on_cube.xml") + " --lockstep --record " + recording_);
  RecordedSamples samples_;
};

// The torque that the stylus gets is the guide's, within the bounds of the scene, and the cube stays on the table.
TEST_F(StylusRun, RendersTheTorqueOfItsOrientation) {
  const RecordedTable& stylus = samples_.tools[0];
  EXPECT_EQ(stylus.name, "stylus");
  double largest = 0, step = 0, error = 0, held = 0;
  const auto& t = stylus.values("t_command_W_x");
  for (std::size_t i = 1; i < t.size(); ++i) {
    largest = std::max(largest, std::abs(t[i]));
    step = std::max(step, std::abs(t[i] - t[i - 1]));
    if (samples_.time[i] < 2.5 || samples_.time[i] > 2.9) continue;
    const Quat q(stylus.values("q_WT_w")[i], stylus.values("q_WT_x")[i], stylus.values("q_WT_y")[i],
                 stylus.values("q_WT_z")[i]);
    const double wanted = std::min(kMaxTorque, kStiffness * (q * Vec3::UnitZ()).cross(Vec3::UnitZ()).norm());
    error = std::max(error, std::abs(std::abs(t[i]) - wanted));
    held = std::max(held, std::abs(t[i]));
  }
  EXPECT_NEAR(held, kMaxTorque, 1e-9);
  EXPECT_LE(largest, kMaxTorque * (1 + 1e-9));
  EXPECT_LE(step, 50e-3 * (1 + 1e-9));  // 50 N m/s
  EXPECT_LT(error, 2e-4);               // the cube leans by 0.2 degrees under the couple; damping of the rest
  const auto& z = samples_.bodies.at(0).values("p_WB_z");
  EXPECT_NEAR(z.back(), z.front(), 1e-3);
}

TEST_F(StylusRun, ReplaysToTheBit) {
  const test::Outcome replay = test::presa("replay " + recording_);
  EXPECT_EQ(replay.status, 0) << replay.out << replay.err;
}

}  // namespace
}  // namespace presa
