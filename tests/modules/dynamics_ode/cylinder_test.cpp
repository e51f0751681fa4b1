#include "framework/geometry/convex_contact/cylinder.h"

#include <numbers>
#include <random>

#include "framework/geometry/rotation_between.h"
#include "tests/modules/dynamics_ode/hull_support.h"
#include "tests/modules/dynamics_ode/support.h"

// Contacts of cylinders, for which prisms and axes stand in. Oracles: the support function of a cylinder, and distances
// of lines.
namespace presa::ode {
namespace {

constexpr double kCylinderRadius = 0.01;

struct Random {
  std::mt19937 generator{5};
  std::normal_distribution<double> normal;
  Quat turn() { return Quat(normal(generator), normal(generator), normal(generator), normal(generator)).normalized(); }
  Vec3 direction() { return Vec3(normal(generator), normal(generator), normal(generator)).normalized(); }
};

/// How far a cylinder along z extends from its centre along `nhat`, in its own frame.
double support(double radius, double length, const Vec3& nhat) {
  return std::abs(nhat.z()) * length / 2 + radius * std::hypot(nhat.x(), nhat.y());
}

Hull ground() {
  Hull out;
  place(boxHull({1, 1, 0.1}), {{0, 0, -0.05}, Quat::Identity()}, out);
  return out;
}

// Exact up to the sine of 1e-3 within which an end counts as flat, or a side as lying: corners are then up to
// (1 - cos(pi/8)) 1e-3 of the radius too high.
TEST(CylinderContact, TouchesAPlaneWithItsTrueRim) {
  Random random;
  CylinderStandIn stand_in;
  const Hull table = ground();
  for (int n = 0; n < 3000; ++n) {
    const double length = n % 2 == 0 ? 0.002 : 0.05;
    const Hull cylinder = cylinderHull(kCylinderRadius, length);
    const double gap = 1e-3 * random.normal(random.generator) * (n % 2 == 0 ? 0.1 : 1);
    Quat q = random.turn();
    if (n % 5 == 0) q = Quat(Eigen::AngleAxisd(1e-4 * (n % 7), random.direction()));  // nearly upright
    if (n % 5 == 1) q = rotationBetween(Vec3::UnitZ(), Vec3(1, 1, 1e-4 * (n % 7)).normalized());
    const double reach = support(kCylinderRadius, length, q.conjugate() * Vec3::UnitZ());
    const Pose X{{0.01, 0.02, reach + gap}, q};
    CylinderTurn turn;
    const Vec3 way = shortestWay(table, stand_in.core(cylinder, X));
    EXPECT_LT((way - Vec3::UnitZ()).norm(), 1e-12);
    const Manifold manifold = contactOf(table, stand_in.facing(cylinder, X, -way, turn), 0.004);
    ASSERT_GT(manifold.count, 0) << n;
    ASSERT_NEAR(deepest(manifold), gap, 1e-4 * kCylinderRadius) << n;
    ASSERT_LT((manifold.nhat_AB_W - Vec3::UnitZ()).norm(), 1e-9) << n;
  }
}

// A cylinder that comes to lie on its side is an axis where it was a prism: what is remembered of the prism's edges and
// faces is of no use then.
TEST(CylinderContact, ForgetsWhatItsStandInDoesNotHave) {
  const Hull table = ground(), cylinder = cylinderHull(kCylinderRadius, 0.05);
  CylinderStandIn stand_in;
  CylinderTurn turn;
  const Pose X{{0, 0, kCylinderRadius}, Quat(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitX()))};
  const Hull& side = stand_in.facing(cylinder, X, -Vec3::UnitZ(), turn);
  ASSERT_TRUE(side.faces.empty());
  ManifoldMaker maker;
  maker.makeRoom(cylinder.edges.size(), cylinder.faces.size());
  for (const auto kind : {ContactAxis::Kind::kEdges, ContactAxis::Kind::kFaceOfB}) {
    ContactAxis memory{kind, 3, static_cast<std::int32_t>(cylinder.edges.size()) - 1};
    Manifold manifold;
    maker.collide(table, side, 0.001, memory, manifold);
    EXPECT_EQ(manifold.count, 2);
  }
}

TEST(CylinderContact, SidesTouchAsFarApartAsTheirAxesLessTheRadii) {
  Random random;
  std::array<CylinderStandIn, 2> stand_ins;
  const Hull cylinder = cylinderHull(kCylinderRadius, 0.1);
  for (int n = 0; n < 2000; ++n) {
    const Vec3 across = random.direction(), a = across.unitOrthogonal();
    const double angle = n % 4 == 0 ? 0 : 0.01 + std::abs(random.normal(random.generator));
    const Vec3 b = Eigen::AngleAxisd(angle, across) * a;
    const double gap = 1e-4 * random.normal(random.generator);
    const Pose X_A{Vec3::Zero(), rotationBetween(Vec3::UnitZ(), a)};
    const Pose X_B{(2 * kCylinderRadius + gap) * across + 0.01 * a, rotationBetween(Vec3::UnitZ(), b)};
    std::array<CylinderTurn, 2> turns;
    const Vec3 way = shortestWay(stand_ins[0].core(cylinder, X_A), stand_ins[1].core(cylinder, X_B));
    const Manifold manifold = contactOf(stand_ins[0].facing(cylinder, X_A, way, turns[0]),
                                        stand_ins[1].facing(cylinder, X_B, -way, turns[1]), 0.001);
    ASSERT_EQ(manifold.count, n % 4 == 0 ? 2 : 1) << n;
    ASSERT_NEAR(deepest(manifold), gap, 1e-9) << n;
    ASSERT_NEAR(manifold.nhat_AB_W.dot(across), 1, 1e-9) << n;
  }
}

TEST(CylinderContact, FlatEndLiesOnEightPoints) {
  Random random;
  std::array<CylinderStandIn, 2> stand_ins;
  const Hull cylinder = cylinderHull(kCylinderRadius, 0.004);
  for (const double tilt : {0.0, 1e-4}) {
    const Pose X_A{{0, 0, 0.002}, Quat::Identity()};
    const Pose X_B{{0.001, 0, 0.006}, Quat(Eigen::AngleAxisd(tilt, Vec3::UnitY()))};
    std::array<CylinderTurn, 2> turns;
    const Vec3 way = shortestWay(stand_ins[0].core(cylinder, X_A), stand_ins[1].core(cylinder, X_B));
    const Manifold on_ground = contactOf(ground(), stand_ins[0].facing(cylinder, X_A, -Vec3::UnitZ(), turns[0]), 1e-4);
    EXPECT_EQ(on_ground.count, 8);
    const Manifold on_each_other = contactOf(stand_ins[0].facing(cylinder, X_A, way, turns[0]),
                                             stand_ins[1].facing(cylinder, X_B, -way, turns[1]), 1e-4);
    EXPECT_GE(on_each_other.count, 4);
    EXPECT_NEAR(on_each_other.nhat_AB_W.z(), 1, 1e-6);
  }
}

// A wheel on a table: a polygon would rattle. Its speed falls only by the solver's rounding, its axis keeps its height.
TEST(CylinderContact, WheelRollsAMetreWithoutRattling) {
  WorldMaker maker;
  const double mass = 0.1, radius = 0.02, speed = 0.5, lying = M_PI / 2;
  const Mat3 inertia = Vec3(1, 1, 2).asDiagonal().toDenseMatrix() * (mass * radius * radius / 4);
  maker.table().add(Cylinder{radius, 0.01}, {{-0.5, 0, radius}, Quat(Eigen::AngleAxisd(lying, Vec3::UnitX()))},
                    {mass, Vec3::Zero(), inertia});
  Runner runner(maker.world());
  runner.bodies.setVelocity(1, {speed, 0, 0}, {0, speed / radius, 0});
  double low = 1e300, high = -1e300;
  while (runner.time < 2) {
    runner.step();
    low = std::min(low, runner[1].X_WB_end.p.z());
    high = std::max(high, runner[1].X_WB_end.p.z());
  }
  EXPECT_NEAR(runner[1].v_WB.x(), speed, 1e-3 * speed);
  EXPECT_LT(high - low, 1e-6);
}

TEST(CylinderContact, DrumsStandOnEachOtherAndSleep) {
  WorldMaker maker;
  maker.table();
  const double mass = 0.2, radius = 0.03, length = 0.05;
  const double about_z = mass * radius * radius / 2, across = mass * (3 * radius * radius + length * length) / 12;
  for (int i = 0; i < 5; ++i) {
    maker.add(Cylinder{radius, length}, {{0.001 * i, 0, length * (i + 0.5)}, Quat::Identity()},
              {mass, Vec3::Zero(), Vec3(across, across, about_z).asDiagonal().toDenseMatrix()});
  }
  Runner runner(maker.world());
  runner.run(3);
  for (std::size_t i = 1; i <= 5; ++i) {
    EXPECT_TRUE(runner[i].asleep) << i;
    EXPECT_NEAR(runner[i].X_WB_end.p.z(), length * (static_cast<double>(i) - 0.5), 1e-5) << i;
  }
}

}  // namespace
}  // namespace presa::ode
