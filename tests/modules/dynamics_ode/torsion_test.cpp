// A soft fingertip resists rotation about its normal: Coulomb friction at a radius.
#include <gtest/gtest.h>

#include "tests/modules/dynamics_ode/support.h"

namespace presa::ode {
namespace {

constexpr double kMass = 0.1, kDepth = 0.003, kStiffness = 1000, kMu = 1;
constexpr double kGrip = kStiffness * kDepth;              // of each finger [N]
constexpr double kTorsion = 0.003;                         // [m]
constexpr double kMaxTorque = 2 * kTorsion * kMu * kGrip;  // maximum torque of both [N m]

std::shared_ptr<const World> cube(double torsional_radius, const Vec3& gravity) {
  WorldMaker maker;
  maker.gravity(gravity).box({kEdge, kEdge, kEdge}, kMass, {});
  auto world = std::make_shared<World>(*maker.world());
  world->scene.devices.resize(2);
  for (Material& material : world->scene.materials) material.torsional_radius = torsional_radius;
  return world;
}

double angleAboutX(const Runner& run) { return 2 * std::atan2(run[0].X_WB_end.q.x(), run[0].X_WB_end.q.w()); }

// A spin about the line between the fingers decelerates with M / I, like a flywheel on a brake, and then stops.
TEST(Torsion, BrakesASpinByAConstantTorque) {
  const double inertia = kMass * kEdge * kEdge / 6, slowing = kMaxTorque / inertia, spin = 20;
  Runner run(cube(kTorsion, Vec3::Zero()), awake());
  run.bodies.setVelocity(0, Vec3::Zero(), {spin, 0, 0});
  std::vector<ReferenceFinger> fingers = pinch(0, kEdge, kDepth, kStiffness, kMu);
  for (int n = 1; n <= 60; ++n) {
    run.step(exchangeOf(fingers, run));
    const double expected = std::max(0.0, spin - slowing * n * kStep);
    // tolerance: one step at the time of stopping; during the spin the grip sways by 0.1 %
    EXPECT_NEAR(run[0].w_WB.x(), expected, expected > 0 ? 0.01 * spin : slowing * kStep) << n;
  }
  EXPECT_NEAR(run[0].w_WB.x(), 0, 1e-4);
}

// Half the friction or half the grip brakes half as fast: the torque is radius times mu times normal force of each
// finger.
TEST(Torsion, IsTheFrictionOfTheGripAtItsRadius) {
  const double inertia = kMass * kEdge * kEdge / 6, spin = 20;
  for (const double mu : {1.0, 0.5, 0.3, 1.6}) {
    for (const double depth : {kDepth, kDepth / 2}) {
      Runner run(cube(kTorsion, Vec3::Zero()), awake());
      run.bodies.setVelocity(0, Vec3::Zero(), {spin, 0, 0});
      std::vector<ReferenceFinger> fingers = pinch(0, kEdge, depth, kStiffness, mu);
      constexpr int kSteps = 5;
      for (int n = 0; n < kSteps; ++n) run.step(exchangeOf(fingers, run));
      const double lost = 2 * kTorsion * mu * kStiffness * depth / inertia * kSteps * kStep;
      ASSERT_LT(lost, spin);
      EXPECT_NEAR(spin - run[0].w_WB.x(), lost, 0.03 * lost) << mu << ' ' << depth;
    }
  }
}

TEST(Torsion, APointTurnsFreely) {
  Runner run(cube(0, Vec3::Zero()), awake());
  run.bodies.setVelocity(0, Vec3::Zero(), {20, 0, 0});
  std::vector<ReferenceFinger> fingers = pinch(0, kEdge, kDepth, kStiffness, kMu);
  for (int n = 0; n < 60; ++n) run.step(exchangeOf(fingers, run));
  EXPECT_NEAR(run[0].w_WB.x(), 20, 0.2);
}

// Held beside its centre of mass, the cube stays while m g l is below the torque, and swings down when it is above.
TEST(Torsion, HoldsALeverUpToItsTorque) {
  for (const double share : {0.8, 1.25}) {
    const double lever = share * kMaxTorque / (kMass * kGravity);
    Runner run(cube(kTorsion, {0, 0, -kGravity}), awake());
    std::vector<ReferenceFinger> fingers = pinch(0, kEdge, kDepth, kStiffness, kMu);
    for (ReferenceFinger& finger : fingers) {
      for (Vec3* p : {&finger.p_BC, &finger.p_BP, &finger.p_WH}) p->y() += lever;
    }
    for (int n = 0; n < 100; ++n) run.step(exchangeOf(fingers, run));
    const double turned = degrees(std::abs(angleAboutX(run)));
    if (share < 1) {
      EXPECT_LT(turned, 1);
    } else {
      EXPECT_GT(turned, 10);
    }
  }
}

}  // namespace
}  // namespace presa::ode
