// Hands that wear the modelled arm: scripted, a simulated subject, the mouse's; and the arm without its properties.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "devices/hand/hand_plugin.h"
#include "devices/percro_arm/properties.h"
#include "devices/percro_arm/simulated_arm.h"
#include "framework/scene/manifest.h"
#include "tests/support/shipped_rig.h"

namespace presa {
namespace {

using testing::HasSubstr;

const std::string kStudy = PRESA_SOURCE_DIR "/experiments/grip_slip/scene.xml";
const std::string kStudyRig = PRESA_SOURCE_DIR "/experiments/grip_slip/rig_percro.xml";
const std::string kCube = PRESA_SOURCE_DIR "/config/scenes/cube.xml";
const std::string kCubeRig = PRESA_SOURCE_DIR "/config/rigs/pinch_cube_percro.xml";
const std::string kIdealRig = PRESA_SOURCE_DIR "/config/rigs/pinch_cube.xml";
constexpr double kPeriod = 1e-3;

percro::Parameters armWithout(std::initializer_list<std::string_view> names) {
  percro::Parameters arm = percro::paperArm();
  for (const std::string_view name : names) {
    const auto found = std::ranges::find(percro::properties(), name, &percro::Property::name);
    EXPECT_NE(found, percro::properties().end()) << name;
    found->remove(arm);
  }
  return arm;
}

DeviceBinding::Setting set(const std::string& value) { return {value, {}}; }

// The subject wants to lift by 40 mm, to hold for 20 s, and to let go: 26 s see the lift, loosening and the hold.
TEST(PercroHands, ASimulatedSubjectHoldsTheCubeThroughTheArms) {
  Diagnostics diagnostics;
  RunOptions options;
  options.duration = 26;
  Loaded loaded = loadWorld({kStudy, kStudyRig, {}}, options, diagnostics);
  ASSERT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  EXPECT_THAT(loaded.devices.at(0)->model(),
              HasSubstr("simulated PERCRO arms, simulated subject, level L1: no device"));
  TerminalRun run(std::move(loaded), {.trace_rate = 1000, .quiet = true, .command = ""});
  run.execute();
  const ObjectSummary& cube = run.result().objects.at(0).summary;
  EXPECT_TRUE(cube.grasped);
  EXPECT_NEAR(cube.highest.z() - cube.start.z(), 0.04, 0.008);
  EXPECT_NEAR(cube.final.z() - cube.start.z(), 0.04, 0.008);
  EXPECT_TRUE(run.result().faults.empty());
}

TEST(PercroHands, TheSubjectsTickNeitherAllocatesNorLocks) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  Diagnostics diagnostics;
  const auto device = test::firstDevice(kStudy, kStudyRig, diagnostics);
  ASSERT_TRUE(device) << diagnostics.text();
  EXPECT_TRUE(device->looks());
  test::expectRealTime(*device);
}

// What is left of the arm is a hundredth of its mass: it lags by that mass times the largest acceleration over the
// hand's stiffness. The ideal device is discretised exactly, the arm to second order in a quarter of a millisecond.
TEST(PercroHands, WithoutItsPropertiesTheArmIsAnIdealDevice) {
  Diagnostics diagnostics;
  const auto arm = test::firstDevice(kCube, kCubeRig, diagnostics, [](DeviceBinding& binding) {
    binding.settings["without"] = set("compliance encoders friction inertia bandwidth heat");
    binding.settings["damping"] = set("8");
  });
  const auto ideal = test::firstDevice(kCube, kIdealRig, diagnostics,
                                       [](DeviceBinding& binding) { binding.settings["damping"] = set("8"); });
  ASSERT_TRUE(arm && ideal) << diagnostics.text();
  double apart = 0, fastest = 0;
  Vec3 before = Vec3::Zero();
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const Tick tick{i, static_cast<double>(i) * kPeriod, kPeriod};
    const FingerInput a = arm->read(tick), b = ideal->read(tick);
    arm->write({}, tick);
    ideal->write({}, tick);
    apart = std::max(apart, (a.p_WH - b.p_WH).norm());
    if (i > 0) fastest = std::max(fastest, (b.v_WH - before).norm() / kPeriod);
    before = b.v_WH;
  }
  const percro::ArmDynamics left(armWithout({"inertia"}), Vec3::Zero());
  const double mass = left.inertia(percro::Joints::Zero())[2], lag = mass * fastest / 300;
  EXPECT_LT(apart, 2 * lag + 10e-6);
  EXPECT_GT(fastest, 0.5);  // [m/s^2]: the motion shakes the arm
}

/// Displacement of a finger of 0.1 kg in the arm after 50 ms of this force along the barrel [m].
double pushed(const percro::Parameters& parameters, double force) {
  percro::SimulatedArm arm(parameters, Vec3::Zero(), kPeriod);
  arm.place({0.75, 0, 0});
  for (int i = 0; i < 50; ++i) arm.advance({.mass = 0.1, .force = {force, 0, 0}});
  return arm.state().x.x() - 0.75;
}

// s = F t^2 / 2 (m + M), within 2 % for the lag of the structure (75 Hz against 50 ms).
TEST(PercroHands, FrictionHoldsTheFingerAndInertiaSlowsIt) {
  const double mass = percro::ArmDynamics(percro::paperArm(), Vec3::Zero()).inertia(percro::Joints::Zero())[2];
  EXPECT_LT(std::abs(pushed(percro::paperArm(), 0.15)), 20e-6);  // 0.2 N of friction holds it; the structure stretches
  const double free = 0.15 * 0.05 * 0.05 / 2 / (0.1 + mass);
  EXPECT_NEAR(pushed(armWithout({"friction"}), 0.15) / free, 1, 0.02);
  const double light = 0.15 * 0.05 * 0.05 / 2 / (0.1 + 0.01 * mass);
  EXPECT_NEAR(pushed(armWithout({"friction", "inertia"}), 0.15) / light, 1, 0.02);
}

TEST(PercroHands, EncodersRoundAndComplianceHides) {
  const Vec3 place(0.7501234, 0.0123, -0.0345);
  percro::SimulatedArm counted(percro::paperArm(), Vec3::Zero(), kPeriod);
  counted.place(place);
  EXPECT_GT((counted.reportedPosition() - place).norm(), 5e-6);
  percro::SimulatedArm exact(armWithout({"encoders"}), Vec3::Zero(), kPeriod);
  exact.place(place);
  EXPECT_LT((exact.reportedPosition() - place).norm(), 1e-12);

  // a motor pushes a bolted tip across the barrel: the joints turn until the structure holds 2 N less friction
  const auto hidden = [](const percro::Parameters& parameters) {
    percro::SimulatedArm arm(parameters, Vec3::Zero(), kPeriod);
    arm.place({0.75, 0, 0});
    arm.command({0, 2, 0});
    for (int i = 0; i < 2000; ++i) arm.advance({.held = true});
    return (percro::tipPosition(parameters.geometry, arm.state().q) - arm.state().x).norm();
  };
  const percro::Parameters bends = armWithout({"friction"}), rigid = armWithout({"friction", "compliance"});
  const double expected = 2 * bends.structure.compliance(0.75);
  EXPECT_NEAR(hidden(bends) / expected, 1, 0.01);
  EXPECT_LT(hidden(rigid), 2e-3 * expected);
}

TEST(PercroHands, TheCurrentLoopLagsAndWarmMotorsGiveLess) {
  percro::MotorDrive slow(percro::paperArm().motors), fast(armWithout({"bandwidth"}).motors);
  for (percro::MotorDrive* drive : {&slow, &fast}) drive->command(Vec3::Zero(), Vec3(0.01, 0, 0));
  EXPECT_LT(slow.step(0.25e-3).x(), 0.006);
  EXPECT_NEAR(fast.step(0.25e-3).x(), 0.01, 1e-5);

  const auto share = [](const percro::Parameters& parameters) {
    percro::SimulatedArm arm(parameters, Vec3::Zero(), kPeriod);
    arm.place({1.0, 0, 0});
    for (int i = 0; i < 60'000; ++i) {
      arm.command({0, 9, 0});
      arm.advance({.held = true});
    }
    return arm.minShare();
  };
  EXPECT_LT(share(percro::paperArm()), 0.9);
  EXPECT_EQ(share(armWithout({"heat"})), 1);
}

// The hand's spring of 300 N/m moves the arm until friction holds it: 0.2 N along the barrel, and counts of 93 um.
TEST(PercroHands, TheMouseLeadsTheArm) {
  Diagnostics diagnostics;
  const auto arm = test::firstDevice(kCube, kCubeRig, diagnostics, [](DeviceBinding& binding) {
    binding.settings.erase("motion");
    binding.settings["hand"] = set("pointer");
  });
  ASSERT_TRUE(arm) << diagnostics.text();
  ASSERT_TRUE(arm->points());
  EXPECT_EQ(arm->model(), "simulated PERCRO arms: no device");
  const Vec3 middle(0.02, 0.03, 0.12);
  Vec3 reached = Vec3::Zero();
  for (std::uint64_t i = 0; i < 4000; ++i) {
    const Tick tick{i, static_cast<double>(i) * kPeriod, kPeriod};
    arm->point({1, middle, 0, 0, 0, 0, {}}, tick);
    reached = arm->read(tick).p_WH;
    arm->write({}, tick);
  }
  const Vec3 thumb = middle - Vec3(0.06 + 0.008, 0, 0);  // half of an open hand, and the fingertip
  EXPECT_LT((reached - thumb).norm(), 0.2 / 300 + 2 * 93e-6);
}

TEST(PercroHands, NamesAHandAndAPropertyThatThereAreNot) {
  Diagnostics diagnostics;
  EXPECT_EQ(test::firstDevice(kCube, kCubeRig, diagnostics,
                              [](DeviceBinding& binding) {
                                binding.settings["hand"] = set("scriptd");
                                binding.settings["without"] = set("friction weight");
                              }),
            nullptr);
  ASSERT_EQ(diagnostics.errorCount(), 2u) << diagnostics.text();
  EXPECT_THAT(diagnostics.text(), HasSubstr("there is no hand 'scriptd' (did you mean 'scripted'?)"));
  EXPECT_THAT(diagnostics.text(), HasSubstr("pointer, scripted, simulated_subject"));
  EXPECT_THAT(diagnostics.text(), HasSubstr("the arm has no property 'weight'"));
  EXPECT_THAT(diagnostics.text(), HasSubstr("compliance, encoders, friction, inertia, bandwidth, heat"));
}

TEST(PercroHands, ARigMaySetWhatTheHandKnows) {
  const auto knows = [](const DeviceBinding& binding, const std::string& key) {
    const auto all = settingsOf(binding);
    return std::ranges::find(all, key, &Manifest::Attribute::name) != all.end();
  };
  DeviceBinding binding{.role = "thumb", .driver = "percro_arm", .settings = {}, .limits = {}, .where = {}};
  EXPECT_TRUE(knows(binding, "pos") && knows(binding, "motion"));
  EXPECT_FALSE(knows(binding, "level"));
  binding.settings["hand"] = set("simulated_subject");
  EXPECT_TRUE(knows(binding, "pos") && knows(binding, "level"));
  EXPECT_FALSE(knows(binding, "motion"));
}

}  // namespace
}  // namespace presa
