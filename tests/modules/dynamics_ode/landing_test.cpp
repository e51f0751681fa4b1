#include "tests/modules/dynamics_ode/support.h"

// Contacts are created ahead of the touch: an arriving body stops at the surface instead of v h (2.5 mm at 0.5 m/s)
// inside it. Tolerance: 20 um, a hundredth of that, for tipping bodies that meet the table at a point that could not be
// predicted.
namespace presa::ode {
namespace {

constexpr double kDeepest = 2e-5;

struct Falling {
  const char* name;
  Shape shape;
  Vec3 bounds;  // of its bounding box
};
void PrintTo(const Falling& falling, std::ostream* out) { *out << falling.name; }

std::vector<Falling> fallings() {
  return {{"Box", Box{{0.04, 0.05, 0.06}}, {0.04, 0.05, 0.06}},
          {"Sphere", Sphere{0.03}, {0.06, 0.06, 0.06}},
          {"Cylinder", Cylinder{0.03, 0.06}, {0.06, 0.06, 0.06}},
          {"Capsule", Capsule{0.02, 0.04}, {0.04, 0.04, 0.08}}};
}

class Landing : public testing::TestWithParam<Falling> {};

double deepestContact(const Runner& runner) {
  double depth = 0;
  for (const BodyContact& contact : runner.bodies.contacts()) depth = std::max(depth, contact.depth);
  return depth;
}

// Landing flat, on an edge and on a corner.
TEST_P(Landing, StopsAtTheSurface) {
  for (const Vec3& axis : {Vec3(Vec3::UnitZ()), Vec3(Vec3::UnitX()), Vec3(1, 0.6, 0.3)}) {
    WorldMaker maker;
    maker.table().add(GetParam().shape, {{0, 0, 0.08}, turn(0.6, axis)},
                      {0.1, Vec3::Zero(), boxInertia(0.1, GetParam().bounds)});
    Runner runner(maker.world(), awake());
    runner.bodies.setVelocity(1, {0, 0, -0.5}, Vec3::Zero());
    double first_touch = 0;
    for (int n = 0; n < 100 && first_touch == 0; ++n) {
      runner.step();
      first_touch = deepestContact(runner);
    }
    EXPECT_LT(first_touch, kDeepest) << axis.transpose();
    EXPECT_FALSE(runner.bodies.contacts().empty()) << "it has landed: " << axis.transpose();
  }
}

// Finally the body lies on the surface without a gap, as if placed there.
TEST_P(Landing, LiesOnTheSurfaceInTheEnd) {
  WorldMaker maker;
  maker.table().add(GetParam().shape, {{0, 0, GetParam().bounds.z() / 2 + 0.01}, Quat::Identity()},
                    {0.1, Vec3::Zero(), boxInertia(0.1, GetParam().bounds)});
  Runner runner(maker.world(), awake());
  runner.run(1);
  EXPECT_NEAR(runner[1].X_WB_end.p.z(), GetParam().bounds.z() / 2, 1e-6);
  EXPECT_LT(runner[1].v_WB.norm(), 1e-6);
}
INSTANTIATE_TEST_SUITE_P(Of, Landing, testing::ValuesIn(fallings()),
                         [](const auto& param) { return std::string(param.param.name); });

// Ten blocks in exact contact, where rounding decides which pairs touch: no block falls a step's distance into the
// next.
TEST(Landing, TowerThatJustTouchesDoesNotSettle) {
  WorldMaker maker;
  maker.table();
  for (int i = 0; i < 10; ++i) maker.box({0.06, 0.1, 0.03}, 0.05, {{0, 0, 0.015 + 0.03 * i}, Quat::Identity()});
  Runner runner(maker.world(), awake());
  for (int n = 0; n < 200; ++n) {
    runner.step();
    ASSERT_LT(deepestContact(runner), kDeepest) << n;
  }
  EXPECT_NEAR(runner[10].X_WB_end.p.z(), 0.285, kDeepest);
  EXPECT_EQ(runner.bodies.fallbackSteps(), 0U);
}

// Passing side by side is not a contact: the motion is not hindered.
TEST(Landing, NearIsNotTouching) {
  WorldMaker maker;
  maker.fixedBox({0.1, 0.1, 0.2}, {{0, 0, 0}, Quat::Identity()});
  maker.box(Vec3::Constant(0.05), 0.1, {{0.0751, 0, 0.1}, Quat::Identity()});
  Runner runner(maker.world(), awake());
  runner.bodies.setVelocity(1, {0, 0.5, 0}, Vec3::Zero());
  runner.run(0.1);
  EXPECT_NEAR(runner[1].v_WB.y(), 0.5, 1e-12);
  EXPECT_NEAR(runner[1].v_WB.z(), -0.1 * kGravity, 1e-12);
}

}  // namespace
}  // namespace presa::ode
