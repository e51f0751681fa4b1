// Two linked fingertips alone, and the whole recording of a calibration on modelled arms.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "devices/hand/finger_plant.h"
#include "devices/linking_hand/linked_pair.h"
#include "framework/scene/load.h"
#include "tests/apps/support/support.h"
#include "tests/support/shipped_rig.h"

namespace presa {
namespace {

using linking::LinkedPair;
using testing::HasSubstr;

constexpr double kPeriod = 1e-3;
const std::string kRig = PRESA_SOURCE_DIR "/config/rigs/pinch_cube_percro.xml";

struct Led {
  double widest_gap = 0, furthest = 0, steadiest = 0;
};

/// 20 s of two ideal fingertips, one of them led; `drag`: of the other [N s/m].
Led lead(std::size_t leader, double drag) {
  LinkedPair pair({.p_WD = {Vec3(-0.75, 0, 0), Vec3(0.75, 0, 0)}, .leader = leader});
  std::array plants{FingerPlant(leader == 0 ? LinkedPair::kLeading : LinkedPair::kLed, kPeriod),
                    FingerPlant(leader == 1 ? LinkedPair::kLeading : LinkedPair::kLed, kPeriod)};
  for (std::size_t i : {0U, 1U}) plants[i].reset(pair.start(i));
  Led led;
  for (std::uint64_t tick = 0; tick < 20'000; ++tick) {
    const double time = static_cast<double>(tick) * kPeriod;
    std::array<HandPush, 2> pushes;
    for (std::size_t i : {0U, 1U}) pushes[i] = pair.push(i, {tick, time, kPeriod});
    for (std::size_t i : {0U, 1U}) {
      const Vec3 resistance = i == leader ? Vec3(Vec3::Zero()) : Vec3(-drag * plants[i].velocity());
      plants[i].step(pushes[i].p_WT, pushes[i].v_WT, pushes[i].with(resistance));
    }
    for (std::size_t i : {0U, 1U}) pair.feel(i, {plants[i].position(), plants[i].velocity(), Vec3::Zero()});
    led.widest_gap = std::max(led.widest_gap, pair.gap());
    led.furthest = std::max(led.furthest, (plants[leader].position() - pair.tipAt(leader, time + kPeriod)).norm());
  }
  return led;
}

// The joint stretches by the force that the led fingertip needs over its stiffness: m a + b v with a < 0.08 (2 pi 0.4)^2
// sqrt(3) = 0.9 m/s^2 and v < 0.35 m/s. The leader lags by the same force over the hand's.
TEST(LinkedPair, TheJointHoldsBothTogether) {
  for (const std::size_t leader : {0U, 1U}) {
    for (const double drag : {0.0, 2.0}) {
      const Led led = lead(leader, drag);
      const double force = LinkedPair::kLed.mass * 0.9 + drag * 0.35;
      EXPECT_LT(led.widest_gap, 1.5 * force / LinkedPair::kStiffness + 1e-9) << leader << " " << drag;
      EXPECT_LT(led.furthest, 1.5 * (force + LinkedPair::kLeading.mass * 0.9) / LinkedPair::kLeading.stiffness);
      EXPECT_GT(led.widest_gap, 0);
    }
  }
}

// Modelled arms with friction, compliance and encoders, through devices, executor and output stage; the tolerance is
// that of the fit through encoder steps of 54 to 132 um (calibration_test.cpp).
TEST(RecordedCalibration, FindsTheSecondArmLedBothWays) {
  for (const int seed : {1, 2, 3}) {
    const std::string samples = test::scratch("link.csv"), rig = test::scratch("rig.xml");
    const test::Outcome outcome = test::presa("device calibrate " + kRig + " --record " + samples + " --rehearse " +
                                              std::to_string(seed) + " --for 10 --out " + rig);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("index leads thumb"));
    EXPECT_THAT(outcome.err, HasSubstr("thumb leads index"));
    EXPECT_THAT(outcome.out, HasSubstr("led by index alone"));
    const std::size_t at = outcome.out.find("missed where it really stands by ");
    ASSERT_NE(at, std::string::npos) << outcome.out;
    double millimetres = 1, degrees = 1;
    ASSERT_EQ(std::sscanf(outcome.out.c_str() + at, "missed where it really stands by %lf mm and %lf deg", &millimetres,
                          &degrees),
              2);
    EXPECT_LT(millimetres, 0.1);
    EXPECT_LT(degrees, 0.05);
    Diagnostics diagnostics;
    loadRig(rig, diagnostics);
    EXPECT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
    // what was recorded says the same again
    const test::Outcome again = test::presa("device calibrate " + kRig + " --samples " + samples);
    EXPECT_EQ(again.status, 0) << again.err;
    EXPECT_EQ(again.out.substr(0, again.out.find('\n')),
              outcome.out.substr(outcome.out.find('\n') + 1, again.out.find('\n')));
  }
}

TEST(LinkingHand, NeedsTwoDevicesAndOneOfThemToLead) {
  const std::string scene = PRESA_SOURCE_DIR "/config/scenes/cube.xml";
  Diagnostics one;
  EXPECT_EQ(test::firstDevice(scene, kRig, one,
                              [](DeviceBinding& binding) {
                                binding.settings["hand"] = {"linking_hand", {}};
                              }),
            nullptr);
  EXPECT_EQ(one.all().at(0).code, 390) << one.text();

  Diagnostics both;
  const Loaded loaded = loadWorld({scene, kRig, {}}, {}, both);
  std::vector<DeviceBinding> bindings = loaded.world->rig.devices;
  for (DeviceBinding& binding : bindings) {
    binding.settings["hand"] = {"linking_hand", {}};
    binding.settings["leads"] = {"toe", {}};
  }
  devicePlugin("percro_arm").create(bindings, loaded.world, {}, both);
  EXPECT_EQ(both.all().at(0).code, 391) << both.text();
}

}  // namespace
}  // namespace presa
