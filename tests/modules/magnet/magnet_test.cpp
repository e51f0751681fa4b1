#include <gtest/gtest.h>

#include <cmath>

#include "framework/haptics/force_effects.h"
#include "modules/dynamics_ode/ode_world.h"
#include "tests/support/alloc_lock_guard.h"
#include "tests/support/effect_field.h"

namespace presa {
namespace {

constexpr double kMaxForce = 2, kRange = 0.04;

PluginElement magnet(std::int32_t body, const std::string& pos) {
  return {"magnet", "magnet", body, {{"max_force", "2"}, {"range", "0.04"}, {"pos", pos}}, {}};
}

/// A free box of 0.1 kg without gravity, which no finger can touch, with a magnet at `pos`.
World boxWithMagnet(const std::string& pos) {
  World world;
  Body body;
  body.name = "box";
  body.physics = Geometry{Box{{0.05, 0.06, 0.07}}, {}, {}};
  world.scene.bodies = {body};
  world.scene.materials.resize(1);
  world.scene.devices.resize(1);
  world.scene.gravity.setZero();
  world.scene.plugin_elements = {magnet(0, pos)};
  world.meshes.resize(1);
  world.inertias = {{0.1, Vec3::Zero(), Vec3(0.085, 0.074, 0.061).asDiagonal().toDenseMatrix() * (1e-3 / 1.2)}};
  return world;
}

const Vec3 kPole{0, 0, 0.02};
const std::string kElement = R"(<magnet max_force="2" range="0.04" pos="0 0 0.02"/>)";

TEST(Magnet, PullsTowardsItsPoleWithAtMostMaxForce) {
  test::EffectField field(kElement);
  double strongest = 0, where = 0;
  const Vec3 direction = Vec3(1, 2, -2) / 3;
  for (double d = 1e-4; d < 0.05; d += 1e-5) {
    const Vec3 f = field.force(kPole + d * direction);
    EXPECT_NEAR(f.dot(direction), -f.norm(), 1e-12);
    EXPECT_LE(f.norm(), kMaxForce * (1 + 1e-12));
    if (f.norm() > strongest) {
      strongest = f.norm();
      where = d;
    }
  }
  // the maximum of u (1 - u^2)^2 is flat: steps of 1e-5 m miss it by a few 1e-7
  EXPECT_NEAR(strongest, kMaxForce, 1e-6);
  EXPECT_NEAR(where, kRange / std::sqrt(5.0), 1e-5);
}

TEST(Magnet, EndsAtItsRange) {
  test::EffectField field(kElement);
  EXPECT_EQ(field.force(kPole + Vec3(kRange, 0, 0)), Vec3::Zero());
  EXPECT_EQ(field.force(kPole + Vec3(0, 1, 0)), Vec3::Zero());
  // goes to zero like (range - d)^2: no step of the force at the border
  EXPECT_LT(field.force(kPole + Vec3(kRange - 1e-5, 0, 0)).norm(), 1e-5);
}

// Potential V(d) = -max_force range / (6 c) (1 - u^2)^3, from integration by hand; the force must be its gradient.
TEST(Magnet, CreatesNoEnergy) {
  test::EffectField field(kElement);
  const double c = 16 / (25 * std::sqrt(5.0));
  const auto potential = [&](const Vec3& p) {
    const double u2 = (p - kPole).squaredNorm() / (kRange * kRange);
    return u2 < 1 ? -kMaxForce * kRange / (6 * c) * std::pow(1 - u2, 3) : 0.0;
  };
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = kPole + 0.045 * Vec3(std::sin(i), std::sin(1.7 * i + 1), std::sin(2.3 * i + 2)) / std::sqrt(3.0);
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 h = kStep * Vec3::Unit(axis);
      const double slope = (potential(p + h) - potential(p - h)) / (2 * kStep);
      // differences of potentials of 0.05 J, rounded to 1e-17, over 2e-6 m
      EXPECT_NEAR(field.force(p)[axis], -slope, 1e-8) << i;
    }
  }
}

TEST(Magnet, NeitherAllocatesNorLocks) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  test::EffectField field(kElement);
  const RealTimeGuard guard;
  for (int i = 0; i < 100; ++i) field.force(kPole + Vec3(0.001 * i, 0, 0));
  EXPECT_EQ(guard.violations(), 0) << guard.first();
}

// A fixed fingertip beside a free box: at each step of the dynamics, the box's momentum and angular momentum equal what the
// haptic ticks up to that step have given it, although 5 of them lie between two steps. Rounding alone for the momentum;
// the integration of the rotation (exact to the third order) for the angular momentum.
TEST(Magnet, GivesTheBodyTheImpulseThatItRenders) {
  auto world = std::make_shared<World>(boxWithMagnet("0.02 0 0"));
  ForceEffects effects(*world);
  Touchables touchables(*world);
  EffectReactions reactions = effects.reactions();
  ode::OdeWorld bodies(world);
  ObjectState objects;
  objects.bodies.resize(1);
  bodies.write(0, objects);
  FingerInput finger;
  finger.p_WH = {0.03, 0.015, 0.01};
  finger.valid = true;
  Vec3 rendered = Vec3::Zero();
  double strongest = 0;
  for (int step = 0; step < 100; ++step) {
    const double begin = 0.005 * step;
    bodies.addReactions(reactions, 0.005);
    const Vec3 given = reactions.bodies[0].impulse_W, turned = reactions.bodies[0].angular_impulse_W;
    bodies.step({}, begin, 0.005, objects);
    EXPECT_LT((given + rendered).norm(), 1e-12) << step;
    EXPECT_LT((0.1 * objects.bodies[0].v_WB - given).norm(), 1e-12) << step;
    const Mat3 R = objects.bodies[0].X_WB_end.q.toRotationMatrix();
    const Vec3 L = R * world->inertias[0].inertia * R.transpose() * objects.bodies[0].w_WB;
    strongest = std::max(strongest, turned.norm());
    EXPECT_LT((L - turned).norm(), 2e-3 * strongest + 1e-12) << step;
    for (int tick = 0; tick < 5; ++tick) {
      const double time = begin + 1e-3 * tick;
      touchables.interpolate(objects, time);
      FingerContact out;
      effects.apply(0, Tick{0, time, 1e-3}, finger, 0.008, touchables, out, reactions);
      rendered += 1e-3 * out.f_H_W;
    }
  }
  EXPECT_GT(rendered.norm(), 0.01);  // the magnet acted
  EXPECT_GT(strongest, 1e-5);
}

}  // namespace
}  // namespace presa
