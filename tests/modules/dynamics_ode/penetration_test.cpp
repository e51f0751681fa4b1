#include <cmath>

#include "tests/modules/dynamics_ode/support.h"

// Penetration in the object state against the actual poses.
namespace presa::ode {
namespace {

std::shared_ptr<const World> boxAt(double z, double mass = 0.1) {
  WorldMaker maker;
  maker.table().box(Vec3::Constant(kEdge), mass, {{0, 0, z}, Quat::Identity()});
  return maker.world();
}

TEST(Penetration, AnEngineThatDoesNotSayIsNotZero) {
  const ObjectState state;
  EXPECT_EQ(state.penetration.points, BodyPenetration::kUnknown);
  EXPECT_TRUE(std::isnan(state.penetration.mean));
  EXPECT_TRUE(std::isnan(state.penetration.worst));
}

// At rest a contact's row, 0 = (erp / h) depth - cfm f, carries a quarter of the weight at each corner:
// depth = g h^2 softness / (4 erp), whatever the mass, by Newton's method as by ODE's direct solver. Softness raised to
// give 61 um. Tolerance 1 %: remaining settling.
TEST(Penetration, AtRestIsTheWeightOverTheContactsStiffness) {
  for (const auto solver : {DynamicsSettings::Solver::kNewton, DynamicsSettings::Solver::kDirect}) {
    for (const double mass : {0.02, 0.1, 2.0}) {
      OdeOptions options = awake();
      options.method.solver = solver;
      options.direct_softness = options.newton.softness = 0.2;
      options.max_contact_cfm = options.newton.max_compliance = 1;
      Runner runner(boxAt(kEdge / 2, mass), options);
      runner.run(3);
      const double depth = kGravity * kStep * kStep * options.direct_softness / (4 * options.contact_erp);
      EXPECT_EQ(runner.state.penetration.points, 4);
      EXPECT_NEAR(runner.state.penetration.mean, depth, 0.01 * depth);
      EXPECT_NEAR(runner.state.penetration.worst, depth, 0.01 * depth);
      EXPECT_NEAR(kEdge / 2 - runner[1].X_WB_end.p.z(), depth, 0.01 * depth) << "it does not stand where it says";
    }
  }
}

// Two boxes on one table, 1 and 3 mm inside it with four corners each, at the first step.
TEST(Penetration, IsTheMeanAndTheWorstOfAllPoints) {
  WorldMaker maker;
  maker.table();
  maker.box(Vec3::Constant(kEdge), 0.1, {{0, 0, kEdge / 2 - 1e-3}, Quat::Identity()});
  maker.box(Vec3::Constant(kEdge), 0.1, {{0.2, 0, kEdge / 2 - 3e-3}, Quat::Identity()});
  Runner runner(maker.world(), awake());
  runner.step();
  EXPECT_EQ(runner.state.penetration.points, 8);
  EXPECT_NEAR(runner.state.penetration.mean, 2e-3, 1e-9);
  EXPECT_NEAR(runner.state.penetration.worst, 3e-3, 1e-9);
}

// Contacts created ahead of the touch have a gap and do not count as penetration.
TEST(Penetration, WhatDoesNotTouchYetHasNone) {
  Runner runner(boxAt(kEdge / 2 + 1e-5), awake());
  runner.step();
  ASSERT_FALSE(runner.bodies.contacts().empty());
  EXPECT_EQ(runner.state.penetration.points, 0);
  EXPECT_EQ(runner.state.penetration.mean, 0);
  EXPECT_EQ(runner.state.penetration.worst, 0);
}

TEST(Penetration, IsCopiedWithTheState) {
  Runner runner(boxAt(kEdge / 2 - 1e-3), awake());
  runner.step();
  const ObjectState copied = runner.state;
  EXPECT_EQ(copied.penetration.points, 4);
  EXPECT_NEAR(copied.penetration.mean, 1e-3, 1e-9);
  EXPECT_NEAR(copied.penetration.worst, 1e-3, 1e-9);
}

}  // namespace
}  // namespace presa::ode
