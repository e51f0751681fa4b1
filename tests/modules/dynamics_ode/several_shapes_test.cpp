#include <array>
#include <numbers>
#include <random>

#include "framework/geometry/convex.h"
#include "framework/scene/inertia.h"
#include "tests/framework/geometry/hollow_meshes.h"
#include "tests/modules/dynamics_ode/support.h"
#include "tests/support/alloc_lock_guard.h"
#include "tests/support/effort.h"

// Bodies of several shapes: cups, trays, frames.
namespace presa::ode {
namespace {

using std::numbers::pi;

constexpr double kRadius = 0.02, kInner = 0.04, kWall = 0.004, kHeight = 0.06;  // of the ball and the cup [m]
constexpr int kStaves = 12;

Pose at(double x, double y, double z) { return {Vec3(x, y, z), Quat::Identity()}; }
Pose turned(const Vec3& p, double angle, const Vec3& axis) { return {p, Quat(Eigen::AngleAxisd(angle, axis))}; }

BodyInertia weighed(const Shape& shape, double mass, const BodyMeshes& meshes = {}) {
  Body body;
  body.mass = mass;
  body.physics = Geometry{shape, {}, {}};
  Diagnostics diagnostics;
  return inertiaOf(body, meshes, diagnostics);
}

BodyInertia ballInertia(double mass) { return weighed(Sphere{kRadius}, mass); }

/// Open upwards, its floor from z = 0 to kWall: a square floor and staves around it.
Compound cupOfStaves() {
  Compound cup;
  const double side = 2 * (kInner + kWall) * std::tan(pi / kStaves);
  cup.parts.push_back({Box{{2 * kInner, 2 * kInner, kWall}}, at(0, 0, kWall / 2), {}});
  for (int i = 0; i < kStaves; ++i) {
    const Quat q(Eigen::AngleAxisd(2 * pi * i / kStaves, Vec3::UnitZ()));
    const Vec3 p = q * Vec3(kInner + kWall / 2, 0, kHeight / 2);
    cup.parts.push_back({Box{{kWall, side, kHeight}}, {p, q}, {}});
  }
  return cup;
}

TEST(SeveralShapes, ACupHoldsABall) {
  const Compound cup = cupOfStaves();
  Runner runner(WorldMaker()
                    .table()
                    .add(cup, at(0, 0, 1e-6), weighed(cup, 0.1))
                    .add(Sphere{kRadius}, at(0.005, 0.002, 0.05), ballInertia(0.05))
                    .world());
  runner.run(6);
  EXPECT_NEAR(runner[1].X_WB_end.p.z(), 0, 1e-6);
  EXPECT_NEAR(runner[2].X_WB_end.p.z(), kWall + kRadius, 1e-6);  // contacts sink in by less at rest (README)
  EXPECT_TRUE(runner[1].asleep);
  EXPECT_TRUE(runner[2].asleep);
}

// The same cup as one convex hull: the ball lies on its closed mouth.
TEST(SeveralShapes, AsOneHullItsMouthIsClosed) {
  const auto hull = std::make_shared<TriMesh>(
      convexHull(test::cup(kStaves, kInner, kInner + kWall, kWall, kHeight).vertices).value());
  Runner runner(WorldMaker()
                    .table()
                    .add(MeshRef{}, at(0, 0, 1e-6), {}, {}, hull)
                    .add(Sphere{kRadius}, at(0.005, 0.002, kHeight + 0.03), ballInertia(0.05))
                    .world());
  runner.run(2);
  EXPECT_NEAR(runner[2].X_WB_end.p.z(), kHeight + kRadius, 2e-6);
}

/// A cup whose mesh is decomposed, on the table, and a ball above its mouth.
std::shared_ptr<const World> decomposedCup(std::size_t max_pieces, const BodyInertia& inertia, double drop) {
  const TriMesh cup = test::cup(24, kInner, kInner + kWall, kWall, kHeight);
  World world = *WorldMaker()
                     .table()
                     .add(MeshRef{}, at(0, 0, 1e-6), inertia, {}, std::make_shared<TriMesh>(cup))
                     .add(Sphere{kRadius}, at(0.005, 0.002, kHeight + kRadius + drop), ballInertia(0.05))
                     .world();
  ConvexPieces pieces;
  for (const TriMesh& piece : decompose(cup, max_pieces, 0.001))
    pieces.pieces.push_back(std::make_shared<TriMesh>(piece));
  world.meshes[1].decomposed = {pieces};
  return std::make_shared<World>(world);
}

// The trap and its cure: in one piece the mouth is closed, in 25 it holds the ball.
TEST(SeveralShapes, ADecomposedCupHoldsABallUnlessItsPiecesAreTooFew) {
  for (const auto& [pieces, floor] : {std::pair<std::size_t, double>{1, kHeight}, {64, kWall}}) {
    Runner runner(decomposedCup(pieces, {0.1, Vec3(0, 0, 0.02), Mat3::Identity() * 1e-4}, 0.01));
    runner.run(6);
    EXPECT_NEAR(runner[2].X_WB_end.p.z(), floor + kRadius, 2e-6) << pieces;
    EXPECT_TRUE(runner[2].asleep) << pieces;
  }
}

// At 20 m/s, 0.1 m a step, a ball neither goes through the floor nor the walls of a cup.
TEST(SeveralShapes, NothingPassesThroughACup) {
  const Compound cup = cupOfStaves();
  for (int shot = 0; shot < 20; ++shot) {
    Runner runner(WorldMaker()
                      .gravity(Vec3::Zero())
                      .add(cup, Pose{}, {})
                      .add(Sphere{0.01}, at(0, 0, 0.02), weighed(Sphere{0.01}, 0.01))
                      .world(),
                  awake());
    const double angle = 0.37 * shot;
    runner.bodies.setVelocity(1, 20 * Vec3(std::cos(angle), std::sin(angle), shot % 2 == 0 ? 0 : -1).normalized(),
                              Vec3::Zero());
    for (int n = 0; n < 100; ++n) {
      runner.step();
      const Vec3 p = runner[1].X_WB_end.p;
      if (p.z() > kHeight) break;  // out through the mouth
      ASSERT_GT(p.z(), 0) << shot;
      ASSERT_LT(p.head<2>().norm(), (kInner + kWall) / std::cos(pi / kStaves)) << shot;
    }
  }
}

// Sliding over the seams of a tray's floor a cube neither jumps nor slows down, and its rim stops it: x = inner width
// / 2 minus half its edge.
TEST(SeveralShapes, ATrayKeepsACube) {
  Compound tray;
  for (int i = -2; i < 2; ++i) tray.parts.push_back({Box{{0.05, 0.2, 0.01}}, at(0.05 * i + 0.025, 0, -0.005), {}});
  for (const double side : {-1.0, 1.0}) {
    tray.parts.push_back({Box{{0.01, 0.2, 0.03}}, at(side * 0.105, 0, 0.005), {}});
    tray.parts.push_back({Box{{0.22, 0.01, 0.03}}, at(0, side * 0.105, 0.005), {}});
  }
  Runner runner(
      WorldMaker().friction(0).add(tray, Pose{}, {}).box(Vec3::Constant(0.04), 0.1, at(-0.07, 0, 0.02)).world(),
      awake());
  runner.run(0.1);
  runner.bodies.setVelocity(1, Vec3(0.5, 0, 0), Vec3::Zero());
  double highest = 0;
  while (runner[1].X_WB_end.p.x() < 0.077) {
    runner.step();
    highest = std::max(highest, runner[1].X_WB_end.p.z());
    ASSERT_LT(runner.time, 1);
    ASSERT_NEAR(runner[1].v_WB.x(), 0.5, 1e-6) << runner[1].X_WB_end.p.x();
  }
  EXPECT_LT(highest, 0.02 + 1e-6);
  runner.run(2);
  EXPECT_LT(std::abs(runner[1].X_WB_end.p.x()), 0.08 + 1e-5);
  EXPECT_NEAR(runner[1].X_WB_end.p.z(), 0.02, 1e-6);
}

// A ball that rolls over the seams of a floor goes on as over one box: height and speed.
TEST(SeveralShapes, ABallRollsOverSeams) {
  Compound floor;
  for (int i = 0; i < 10; ++i) floor.parts.push_back({Box{{0.05, 0.2, 0.02}}, at(0.05 * i + 0.025, 0, -0.01), {}});
  for (const double speed : {0.1, 0.5, 1.0}) {
    Runner runner(WorldMaker()
                      .friction(0.5)
                      .add(floor, Pose{}, {})
                      .add(Sphere{kRadius}, at(0.02, 0.003, kRadius), ballInertia(0.05))
                      .world(),
                  awake());
    runner.run(0.1);
    runner.bodies.setVelocity(1, Vec3(speed, 0, 0), Vec3(0, speed / kRadius, 0));
    while (runner[1].X_WB_end.p.x() < 0.4) {
      runner.step();
      ASSERT_NEAR(runner[1].X_WB_end.p.z(), kRadius, 1e-6) << speed << " m/s at " << runner[1].X_WB_end.p.x();
      ASSERT_NEAR(runner[1].v_WB.x(), speed, 1e-4 * speed) << runner[1].X_WB_end.p.x();
    }
  }
}

Compound eightCubes(double edge) {
  Compound cubes;
  for (int i = 0; i < 8; ++i) {
    const Vec3 sign((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
    cubes.parts.push_back({Box{Vec3::Constant(edge / 2)}, {edge / 4 * sign, Quat::Identity()}, {}});
  }
  return cubes;
}

// Eight cubes that make up one fall, tip and rest like it. When they land flat, to rounding. When they land tilted, the
// parts have corners where the whole has edges: those may come into reach a step before the whole's own corner does.
TEST(SeveralShapes, EightCubesAreOne) {
  const Compound cubes = eightCubes(0.05);
  const BodyInertia eight = weighed(cubes, 0.2), one = weighed(Box{kCube}, 0.2);
  EXPECT_LT(eight.p_BCm.norm(), 1e-15);
  EXPECT_LT((eight.inertia - one.inertia).norm(), 1e-15);
  for (const auto& [tilt, tolerance] : {std::pair{0.0, 1e-10}, std::pair{0.1, 2e-6}}) {
    const Pose start = turned(Vec3(0, 0, 0.08), tilt, Vec3(1, 0.3, 0).normalized());
    Runner whole(WorldMaker().table().add(Box{kCube}, start, one).world(), awake());
    Runner parts(WorldMaker().table().add(cubes, start, eight).world(), awake());
    double apart = 0;
    for (int n = 0; n < 400; ++n) {
      whole.step();
      parts.step();
      apart = std::max(apart, (whole[1].X_WB_end.p - parts[1].X_WB_end.p).norm());
    }
    EXPECT_LT(apart, tolerance) << tilt;
    EXPECT_NEAR(parts[1].X_WB_end.p.z(), 0.025, 1e-6) << tilt;
  }
}

/// Two shapes side by side.
Compound pairOf(const Shape& a, const Shape& b, double apart) {
  Compound pair;
  pair.parts.push_back({a, at(-apart / 2, 0, 0), {}});
  pair.parts.push_back({b, at(apart / 2, 0, 0), {}});
  return pair;
}

// Spinning at 20 m/s, or hit at 20 m/s, none of these bodies passes a plate of 0.5 mm: cubes of eight, tiles of two
// halves, dumbbells, hammers.
TEST(SeveralShapes, DoNotPassAThinPlate) {
  constexpr double kSize = 0.01, kSpeed = 20, kThick = 0.0005;
  const std::array<Compound, 4> bodies{
      eightCubes(kSize), pairOf(Box{{kSize / 2, kSize, kSize / 10}}, Box{{kSize / 2, kSize, kSize / 10}}, kSize / 2),
      pairOf(Sphere{kSize / 3}, Sphere{kSize / 3}, kSize),
      pairOf(Box{Vec3::Constant(kSize / 2)}, Box{{kSize, kSize / 10, kSize / 10}}, 0.75 * kSize)};
  std::mt19937 generator(5);
  std::normal_distribution<double> normal;
  for (const bool plate_moves : {false, true}) {
    int through = 0;
    for (std::size_t n = 0; n < unlessSanitized<std::size_t>(400, 40); ++n) {
      const Compound& body = bodies[n % 4];
      WorldMaker maker;
      maker.gravity(Vec3::Zero());
      maker.add(Box{{1, 1, kThick}}, at(0, 0, -kThick / 2),
                plate_moves ? weighed(Box{{1, 1, kThick}}, 1000) : BodyInertia{});
      const Quat q = Quat(normal(generator), normal(generator), normal(generator), normal(generator)).normalized();
      maker.add(body, {Vec3(0, 0, 0.02 + 0.0005 * static_cast<double>(n)), q}, weighed(body, 0.01));
      Runner runner(maker.world());
      const Vec3 spin = 200 * Vec3(normal(generator), normal(generator), normal(generator));
      runner.bodies.setVelocity(1, {0, 0, plate_moves ? 0 : -kSpeed}, spin);
      if (plate_moves) runner.bodies.setVelocity(0, {0, 0, kSpeed}, Vec3::Zero());
      for (int k = 0; k < 200 && runner.time * kSpeed < 1; ++k) runner.step();
      if ((runner[1].X_WB_end.p - runner[0].X_WB_end.p).z() < 0) ++through;
    }
    EXPECT_EQ(through, 0) << plate_moves;
  }
}

// A hammer falls on its side: head and handle lie on the table, where the handle is thinner, and it sleeps.
TEST(SeveralShapes, AHammerComesToRest) {
  Compound hammer;
  hammer.parts.push_back({Box{{0.03, 0.08, 0.03}}, at(0, 0, 0), {}});
  hammer.parts.push_back({Cylinder{0.01, 0.2}, turned(Vec3(0.115, 0, 0), pi / 2, Vec3::UnitY()), {}});
  Runner runner(WorldMaker().table().add(hammer, at(0, 0, 0.05), weighed(hammer, 0.5)).world());
  runner.run(6);
  EXPECT_TRUE(runner[1].asleep);
  // leans on the far end of its handle: the head stands on one edge
  const Vec3 end = runner[1].X_WB_end * Vec3(0.215, 0, 0);
  EXPECT_GT(end.z(), 0.009);
}

TEST(SeveralShapes, StepsAllocateNothing) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  const Compound cup = cupOfStaves();
  const BodyInertia inertia = weighed(cup, 0.1);
  WorldMaker maker;
  maker.table();
  for (int i = 0; i < 3; ++i) maker.add(cup, turned(Vec3(0, 0, 0.05 + 0.1 * i), 0.4 * i, Vec3::UnitX()), inertia);
  Runner runner(maker.world(), awake());
  runner.run(0.5);
  for (int n = 0; n < 100; ++n) {
    const RealTimeGuard guard;
    runner.step();
    ASSERT_EQ(guard.violations(), 0) << guard.first() << " at " << runner.time;
  }
}

}  // namespace
}  // namespace presa::ode
