#include <gtest/gtest.h>

#include <cmath>

#include "devices/falcon_model/legs.h"
#include "tests/devices/falcon_model/host.h"

namespace presa::falcon_model::test {
namespace {

// At rest the spring of the hand balances the motors: 500 N/m, so 2 mm per newton.
TEST(FalconGrip, PushesTheHandAwayByForceOverStiffness) {
  Grip grip({});
  const Vec3 rest = grip.position();
  grip.drive({-249, -249, -249});
  grip.advance(3);
  // the motor words stay constant, so the force at the new place equals the spring force
  EXPECT_NEAR((grip.position() - rest).z(), grip.force().z() / 500, 1e-9);
  EXPECT_GT(grip.force().z(), 0.9);
  EXPECT_LT(grip.force().head<2>().norm(), 1e-12) << "three equal words push along z";
  EXPECT_EQ(grip.counters()[0], grip.counters()[1]);
}

// m x'' = -k x - (b_hand + b_device) x': half a period of the damped oscillation after a step of the hand by 1 mm.
TEST(FalconGrip, SwingsAsMassSpringAndDamperDo) {
  GripSettings settings;
  settings.hand_damping = 1;
  Grip grip(settings);
  const Vec3 rest = grip.position();
  grip.hand([&](double time) -> Vec3 { return rest + Vec3(0, 0, time > 0.99995 ? 0.001 : 0.0); });
  grip.advance(1.0);
  const double decay = 2 / (2 * 0.1), omega = std::sqrt(500 / 0.1 - decay * decay);
  const double half = M_PI / omega;
  // the damper's impulse from the step has no effect after half a period; a delay of one grid step is 0.06 %
  grip.advance(1.0 + half);
  EXPECT_NEAR((grip.position() - rest).z(), 0.001 * (1 + std::exp(-decay * half)), 0.001 * 0.002);
}

// Encoders count from zero at power-on until each has passed its reference inwards while homing is requested.
TEST(FalconGrip, ReferencesAreFoundOnTheWayIn) {
  FalconModel model(running(false));
  Host host(model);
  host.toOperation();
  host.cycles({.homing = true}, 5);
  EXPECT_EQ(host.last->counters, (std::array{0, 0, 0})) << "wherever it was at power-on";
  EXPECT_EQ(host.last->homed, 0U);
  double z = 0.170;
  model.grip().hand([&](double) -> Vec3 { return {0, 0, z}; });
  host.cycles({.homing = true}, 400);
  EXPECT_EQ(host.last->homed, 0U) << "out is not enough";
  std::vector<unsigned> seen;
  for (; z > 0.120; z -= 0.0001) {
    host.cycle({.homing = true});
    if (host.last && (seen.empty() || seen.back() != host.last->homed)) seen.push_back(host.last->homed);
  }
  EXPECT_EQ(seen, (std::vector<unsigned>{0, 1, 3, 7})) << "their references lie a little apart";
  const auto p_D =
      gripAt(Vec3::Constant(kThighAtZero) +
                 kThighPerCount * Vec3(host.last->counters[0], host.last->counters[1], host.last->counters[2]),
             {0, 0, 0.11});
  EXPECT_LT((*p_D - model.grip().position()).norm(), 1e-4) << "counters are true now";
}

TEST(FalconGrip, WithoutHomingAskedForInEveryRequestNoReferenceIsFound) {
  FalconModel model(running(false));
  Host host(model);
  host.toOperation();
  double z = 0.170;
  model.grip().hand([&](double) -> Vec3 { return {0, 0, z}; });
  host.cycles({.homing = true}, 400);
  z = 0.160;  // still outside all references
  host.cycles({.homing = true}, 200);
  z = 0.120;
  host.cycles({}, 100);
  host.cycles({.homing = true}, 400);
  EXPECT_EQ(host.last->homed, 0U);
}

// The end stops keep the grip within the reach of the legs, wherever the hand pulls.
TEST(FalconGrip, EndStopsKeepItWhereLegsReach) {
  Grip grip({});
  grip.reference();
  int corner = 0;
  grip.hand([&](double) -> Vec3 {
    return {corner & 1 ? 0.2 : -0.2, corner & 2 ? 0.2 : -0.2, corner & 4 ? 0.4 : -0.1};
  });
  for (; corner < 8; ++corner) {
    grip.advance(1.0 + corner);
    EXPECT_TRUE(thighsAt(grip.position())) << grip.position().transpose();
    EXPECT_LT(grip.velocity().norm(), 1e-3);
    const auto counters = grip.counters();
    const Vec3 counted = Vec3::Constant(kThighAtZero) + kThighPerCount * Vec3(counters[0], counters[1], counters[2]);
    EXPECT_LE((counted - *thighsAt(grip.position())).cwiseAbs().maxCoeff(), kThighPerCount / 2 * (1 + 1e-9));
  }
}

TEST(FalconGrip, ButtonsJumpsAndLostReferencesAreReported) {
  FalconModel model(running());
  Host host(model);
  host.toOperation();
  host.cycles({}, 3);
  const auto before = host.last->counters;
  model.buttons(4 | 8);
  model.grip().jump(1, 1000);
  model.grip().loseReference(2);
  host.cycles({}, 3);
  EXPECT_EQ(host.last->buttons, 12U);
  EXPECT_EQ(host.last->homed, 3U);
  EXPECT_EQ(host.last->counters, (std::array{before[0], before[1] + 1000, before[2]}));
}

}  // namespace
}  // namespace presa::falcon_model::test
