// The arms in the whole program: lockstep, shipped scene and rig.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "apps/common/grasp_figures.h"
#include "devices/percro_arm/kinematics.h"
#include "devices/percro_arm/thimble.h"
#include "tests/support/shipped_rig.h"

namespace presa {
namespace {

const std::string kScene = PRESA_SOURCE_DIR "/config/scenes/cube.xml";
const std::string kRig = PRESA_SOURCE_DIR "/config/rigs/pinch_cube_percro.xml";

std::unique_ptr<TerminalRun> lift(const std::vector<std::string>& sets = {}) {
  return test::runToTheEnd(kScene, kRig, sets);
}

// Tolerances: rendered forces change in steps of the stiffness times the barrel's 60 um (0.06 N), the joints' friction
// adds 0.2 N at the hand, and the grip loosens by 3 N/s.
TEST(PercroDevice, TwoArmsLiftTheCube) {
  const auto run = lift();
  const auto grasp = graspFigures(run->result());
  ASSERT_TRUE(grasp);
  EXPECT_NEAR(grasp->lift_height, 0.10, 0.001);
  EXPECT_NEAR(grasp->held_in_stick, 4.0, 0.002);
  ASSERT_EQ(grasp->fingers.size(), 2u);
  for (const FingerGrasp& finger : grasp->fingers) {
    EXPECT_NEAR(finger.mean_normal_force, 6, 0.2 + 0.06);
    EXPECT_NEAR(finger.weight_share, 1, 0.1);
    ASSERT_TRUE(finger.slip);
    EXPECT_NEAR(finger.slip->normal_force, 0.2 * 9.81 / (2 * 0.8), 0.06);
  }
  const ObjectSummary& cube = run->result().objects.at(0).summary;
  EXPECT_FALSE(cube.dropped);
  EXPECT_GT(cube.lost_at, 7.0);
  EXPECT_TRUE(run->result().faults.empty());
}

TEST(PercroDevice, StiffAndLightCubesAreHeldToo) {
  for (const double mass : {0.02, 0.4}) {
    for (const double stiffness : {500.0, 2000.0, 5000.0}) {
      const auto run = lift(
          {"body/cube/physics/mass=" + std::to_string(mass), "material/rubber/stiffness=" + std::to_string(stiffness)});
      const auto grasp = graspFigures(run->result());
      ASSERT_TRUE(grasp);
      EXPECT_NEAR(grasp->held_in_stick, 4.0, 0.002) << mass << " kg, " << stiffness << " N/m";
      for (const FingerGrasp& finger : grasp->fingers) EXPECT_LT(finger.grip_ripple.value_or(1), 0.05);
    }
  }
}

TEST(PercroDevice, TheSameInputGivesTheSameBits) {
  EXPECT_EQ(lift()->result().state_hash, lift()->result().state_hash);
}

std::unique_ptr<Device> thumb(
    Diagnostics& diagnostics, const std::function<void(DeviceBinding&)>& change = [](DeviceBinding&) {}) {
  return test::firstDevice(kScene, kRig, diagnostics, change);
}

// Reported positions are whole counts, transformed by the base pose of the rig.
TEST(PercroDevice, ReportsWholeCountsThroughTheBasePose) {
  Diagnostics diagnostics;
  const auto device = thumb(diagnostics);
  ASSERT_TRUE(device) << diagnostics.text();
  const percro::Parameters arm = percro::paperArm();
  const double half = std::sqrt(0.5);
  const Pose X_WD{{-0.75, 0, 0.1}, Quat(half, half, 0, 0)};
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const Tick tick{i, static_cast<double>(i) * 1e-3, 1e-3};
    const FingerInput input = device->read(tick);
    device->write({}, tick);
    ASSERT_TRUE(input.valid);
    const Vec3 counts = percro::transmission(arm.geometry) *
                        percro::jointsAt(arm.geometry, X_WD.inverseTimes(input.p_WH)) / arm.motors.count();
    ASSERT_LT((counts - Vec3(counts.array().round())).cwiseAbs().maxCoeff(), 1e-4) << i;  // the rig's 8 digits
  }
}

// The modelled finger keeps its orientation while the barrel turns under it. The thimble reports it through the three
// encoders of the wrist, half a count of error each, and the barrel's, which add less than 0.3 mrad.
TEST(PercroDevice, ReportsTheThimblesOrientation) {
  Diagnostics diagnostics;
  const auto device = thumb(diagnostics);
  ASSERT_TRUE(device) << diagnostics.text();
  EXPECT_TRUE(device->measuresOrientation());
  const Pose X_WD{{-0.75, 0, 0.1}, Quat(std::sqrt(0.5), std::sqrt(0.5), 0, 0)};
  const percro::Geometry geometry = percro::paperArm().geometry;
  Quat first = Quat::Identity();
  double error = 0, barrel = 0;
  Mat3 start = Mat3::Identity();
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const Tick tick{i, static_cast<double>(i) * 1e-3, 1e-3};
    const FingerInput input = device->read(tick);
    device->write({}, tick);
    ASSERT_TRUE(input.oriented);
    const Mat3 R = percro::barrelFrame(percro::jointsAt(geometry, X_WD.inverseTimes(input.p_WH)));
    if (i == 0) first = input.q_WT, start = R;
    error = std::max(error, input.q_WT.angularDistance(first));
    barrel = std::max(barrel, Eigen::AngleAxisd(R * start.transpose()).angle());
    ASSERT_LT(input.w_WT.norm(), 0.5);  // a count in 1 ms, smoothed over 10 ms: 0.15 rad/s each
  }
  EXPECT_LT(error, std::sqrt(3) * percro::Thimble::kCount / 2 + 3e-4);
  EXPECT_GT(barrel, 0.05);
}

TEST(PercroDevice, ItsTickNeitherAllocatesNorLocks) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  Diagnostics diagnostics;
  const auto device = thumb(diagnostics);
  ASSERT_TRUE(device) << diagnostics.text();
  test::expectRealTime(*device);
}

TEST(PercroDevice, RefusesABaseFromWhichTheMotionIsOutOfReach) {
  Diagnostics diagnostics;
  const auto device = thumb(diagnostics, [](DeviceBinding& b) { b.settings.at("pos").value = "-1.3 0 0.1"; });
  EXPECT_EQ(device, nullptr);
  ASSERT_EQ(diagnostics.errorCount(), 1u) << diagnostics.text();
  EXPECT_EQ(diagnostics.all()[0].code, 462);
}

TEST(PercroDevice, NamesEverySettingThatIsWrong) {
  Diagnostics diagnostics;
  const auto device = thumb(diagnostics, [](DeviceBinding& b) {
    b.settings.at("pos").value = "0 0";
    b.settings.at("quat").value = "0 0 0 0";
  });
  EXPECT_EQ(device, nullptr);
  EXPECT_EQ(diagnostics.errorCount(), 2u) << diagnostics.text();
  Diagnostics missing;
  EXPECT_EQ(thumb(missing, [](DeviceBinding& b) { b.settings.erase("pos"); }), nullptr);
  EXPECT_EQ(missing.all().at(0).code, 460);
}

}  // namespace
}  // namespace presa
