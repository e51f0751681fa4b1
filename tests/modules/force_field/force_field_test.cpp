#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "framework/core/diagnostics/diagnostics.h"
#include "tests/support/alloc_lock_guard.h"
#include "tests/support/effect_field.h"

namespace presa {
namespace {

const std::string kWind = R"(<force_field max_force="2" force="0 -0.3 0.4"/>)";
const std::string kHoney =
    R"(<force_field max_force="3" viscosity="10" pos="0 0 0.05" size="0.1 0 0.06" edge="0.01"/>)";

TEST(ForceField, PushesEverywhereTheSame) {
  test::EffectField field(kWind);
  EXPECT_EQ(field.force({0, 0, 0}), Vec3(0, -0.3, 0.4));
  EXPECT_EQ(field.force({3, -7, 20}, {1, 1, 1}), Vec3(0, -0.3, 0.4));
  EXPECT_EQ(field.impulse(), Vec3::Zero());  // it belongs to no body
}

TEST(ForceField, IsViscousInItsBox) {
  test::EffectField field(kHoney);
  const Vec3 v(0.1, -0.05, 0.02);
  EXPECT_EQ(field.force({0, 0, 0.05}, v), -10 * v);
  EXPECT_EQ(field.force({0.039, 25, 0.069}, v), -10 * v);  // no end along y
  EXPECT_EQ(field.force({0.051, 0, 0.05}, v), Vec3::Zero());
  EXPECT_EQ(field.force({0, 0, 0.0801}, v), Vec3::Zero());
  // half of the edge: a half of the smooth step
  EXPECT_LT((field.force({0.045, 0, 0.05}, v) + 5 * v).norm(), 1e-14);
}

// The force of a finger that moves through a face at 0.5 m/s changes in no tick by more than 3/2 c v^2 T / edge.
TEST(ForceField, ItsEdgeIsNoStep) {
  test::EffectField field(R"(<force_field max_force="20" viscosity="10" size="0.1 0.1 0.1" edge="0.01"/>)");
  const double speed = 0.5, period = 1e-3;
  Vec3 last = Vec3::Zero();
  double largest = 0;
  for (double x = -0.06; x < 0.06; x += speed * period) {
    const Vec3 f = field.force({x, 0, 0}, {speed, 0, 0});
    largest = std::max(largest, (f - last).norm());
    last = f;
  }
  EXPECT_LE(largest, 1.5 * 10 * speed * speed * period / 0.01 * (1 + 1e-12));
  EXPECT_GT(largest, 0.1);
}

// What the constant force leaves of the bound is there for the viscous one, which never pushes.
TEST(ForceField, TheBoundTakesFromTheViscousForce) {
  test::EffectField field(R"(<force_field max_force="1" force="0 0 0.8" viscosity="20"/>)");
  for (int i = 0; i < 500; ++i) {
    const Vec3 v = 0.5 * Vec3(std::cos(3.1 * i), std::sin(2.9 * i), std::cos(i));
    const Vec3 f = field.force({0, 0, 0}, v), viscous = f - Vec3(0, 0, 0.8);
    EXPECT_LE(f.norm(), 1 + 1e-12);
    EXPECT_LE(viscous.dot(v), 1e-12);
    EXPECT_LT(viscous.cross(v).norm(), 1e-12);
  }
}

TEST(ForceField, NeitherAllocatesNorLocks) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  test::EffectField field(kHoney);
  const RealTimeGuard guard;
  for (int i = 0; i < 100; ++i) field.force({0.001 * i, 0, 0.02}, {1, 0, 0});
  EXPECT_EQ(guard.violations(), 0) << guard.first();
}

TEST(ForceField, RefusesWhatItCannotGive) {
  const auto wrong = [](const std::string& attributes) {
    try {
      test::EffectField field("<force_field max_force=\"1\" " + attributes + "/>");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("taken");
  };
  EXPECT_THAT(wrong(R"(force="1 1 0")"), testing::HasSubstr("force is longer than max_force"));
  EXPECT_THAT(wrong(R"(size="0 -1 0")"), testing::HasSubstr("size is negative"));
}

}  // namespace
}  // namespace presa
