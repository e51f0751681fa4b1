#include <Eigen/Dense>
#include <array>
#include <random>

#include "modules/dynamics_ode/contact_solver/block_cholesky.h"
#include "tests/modules/dynamics_ode/support.h"
#include "tests/support/effort.h"

// Presa's own contact solvers: their linear algebra against a dense solution, and piles that ODE's solvers lose, judged by
// energy, speed and place. A tower of 20 may tip, so its energy is the oracle: it never rises.
namespace presa::ode {
namespace {

using SolverKind = DynamicsSettings::Solver;

TEST(BlockCholesky, SolvesLikeADenseFactorisation) {
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  for (const std::size_t count : {1U, 5U, 30U}) {
    std::vector<BlockCholesky::Pair> pairs;
    for (std::size_t n = 0; n < 2 * count; ++n) {
      pairs.emplace_back(static_cast<std::int32_t>(generator() % count),
                         static_cast<std::int32_t>(generator() % count));
    }
    BlockCholesky matrix(count);
    ASSERT_TRUE(matrix.analyse(count, pairs, 1U << 20U));
    matrix.setZero();
    const auto size = static_cast<Eigen::Index>(6 * count);
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(size, size);
    const auto add = [&](std::int32_t i, std::int32_t j, const BlockCholesky::Block& block) {
      matrix.add(i, j, block);
      dense.block<6, 6>(6 * i, 6 * j) += block;
      if (i != j) dense.block<6, 6>(6 * j, 6 * i) += block.transpose();
    };
    for (std::size_t i = 0; i < count; ++i) {
      add(static_cast<std::int32_t>(i), static_cast<std::int32_t>(i), 60 * BlockCholesky::Block::Identity());
    }
    for (const auto& [i, j] : pairs) {
      if (i != j) add(i, j, BlockCholesky::Block::NullaryExpr([&] { return normal(generator); }));
    }
    BlockCholesky::Vector x(count);
    Eigen::VectorXd b(size);
    for (std::size_t i = 0; i < count; ++i) {
      x[i] = BlockCholesky::Vector::value_type::NullaryExpr([&] { return normal(generator); });
      b.segment<6>(static_cast<Eigen::Index>(6 * i)) = x[i];
    }
    ASSERT_TRUE(matrix.factorise());
    matrix.solve(x);
    const Eigen::VectorXd expected = dense.ldlt().solve(b);
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_LT((x[i] - expected.segment<6>(static_cast<Eigen::Index>(6 * i))).norm(), 1e-12);
    }
  }
}

TEST(BlockCholesky, AChainCostsTheSamePerBody) {
  BlockCholesky matrix(400);
  std::vector<BlockCholesky::Pair> chain;
  for (std::int32_t i = 1; i < 400; ++i) chain.emplace_back(i - 1, i);
  ASSERT_TRUE(matrix.analyse(400, chain, 1U << 20U));
  EXPECT_LE(matrix.work(), 3U * 400U);
  EXPECT_FALSE(matrix.analyse(400, chain, 100)) << "more work than allowed";
  EXPECT_FALSE(matrix.analyse(BlockCholesky::kMaxCount + 1, {}, 1U << 20U));
}

/// `gap` below block `above` [m]; `push`: speed per block, in x [m/s].
std::shared_ptr<const World> cubeTower(int blocks, double mass, double gap = 0, int above = 0, double push = 0) {
  WorldMaker maker;
  maker.friction(0.6, 0.5).fixedBox({60, 60, 0.1}, {{0, 0, -0.05}, Quat::Identity()});
  for (int i = 0; i < blocks; ++i) {
    maker.box(kCube, mass, {{0, 0, kEdge * (i + 0.5) + (i >= above ? gap : 0)}, Quat::Identity()});
  }
  auto world = std::make_shared<World>(*maker.world());
  for (int i = 0; i < blocks; ++i) world->scene.bodies[static_cast<std::size_t>(i) + 1].v_WCm.x() = push * i;
  return world;
}

// ODE's iterative solver lets 40 walk by 20 mm and explode; its direct one holds 60 in 12 times the period.
TEST(Tower, OfSixtyStandsAMinute) {
  Runner runner(cubeTower(60, 0.1), awake());
  double fastest = 0;
  for (int n = 0; n < unlessSanitized(60, 3) * 200; ++n) {
    runner.step();
    for (const BodyMotion& body : runner.state.bodies) fastest = std::max(fastest, body.v_WB.norm());
  }
  EXPECT_LT((runner[60].X_WB_end.p - Vec3(0, 0, 59.5 * kEdge)).norm(), 5e-4);
  EXPECT_LT(fastest, 0.02);
  for (const BodyMotion& body : runner.state.bodies) EXPECT_LT(body.v_WB.norm(), 1e-9);
  EXPECT_LT(runner.state.energy.sum, 1e-6);
}

// 20 cubes, 1 kg in all, each pushed a little faster than the one below. In the end they lie flat: what can be set free
// is m g times the fall of their centres, 4.7 J.
TEST(Tower, PushedOverNeverGainsEnergy) {
  Runner runner(cubeTower(20, 0.05, 0, 0, 0.054));
  double fastest = 0;
  for (int n = 0; n < 600; ++n) {
    runner.step();
    for (const BodyMotion& body : runner.state.bodies) fastest = std::max(fastest, body.v_WB.norm());
  }
  const double free = 0.05 * kGravity * kEdge * 20 * 19 / 2;
  EXPECT_LT(runner.state.energy.sum, 0.005 * free);
  EXPECT_LT(runner.state.energy.worst_step, 0.005 * free);
  EXPECT_LT(fastest, 1.5 * std::sqrt(2 * kGravity * 20 * kEdge))
      << "the tip of a falling chimney is faster than a stone";
  EXPECT_LT(runner[20].v_WB.norm(), 1e-3);
}

class Merge : public testing::TestWithParam<double> {};

// Ten cubes fall on a tower of ten: with ODE's iterative solver the top was thrown up at 1.7 m/s.
TEST_P(Merge, ThrowsNothingUp) {
  Runner runner(cubeTower(20, 0.1, GetParam(), 10));
  double up = 0;
  for (int n = 0; n < 400; ++n) {
    runner.step();
    for (const BodyMotion& body : runner.state.bodies) up = std::max(up, body.v_WB.z());
  }
  EXPECT_LT(up, 0.05);
  EXPECT_NEAR(runner[20].X_WB_end.p.z(), 19.5 * kEdge, 5e-4);
}
INSTANTIATE_TEST_SUITE_P(FromHeight, Merge, testing::Values(0.005, 0.02, 0.05),
                         [](const auto& param) { return std::to_string(std::lround(param.param * 1e3)) + "mm"; });

// Poured into a bin, cubes in any orientation come to rest and fall asleep, whether solved in small steps or otherwise.
TEST(Heap, PouredComesToRestAndSleeps) {
  WorldMaker maker;
  maker.friction(0.6, 0.5).table();
  for (const double side : {-0.15, 0.15}) {
    maker.fixedBox({0.02, 0.6, 0.6}, {{side, 0, 0.3}, Quat::Identity()});
    maker.fixedBox({0.6, 0.02, 0.6}, {{0, side, 0.3}, Quat::Identity()});
  }
  std::mt19937 generator(1);
  std::normal_distribution<double> normal;
  double height = 0;
  constexpr int kCubes = unlessSanitized(100, 50);
  for (int i = 0; i < kCubes; ++i) {
    const Vec3 p(0.054 * (i % 5 - 2), 0.054 * (i / 5 % 5 - 2), 0.04 + 0.056 * (i / 25));
    const Quat q(normal(generator), normal(generator), normal(generator), normal(generator));
    maker.box(Vec3::Constant(0.03), 0.027, {p, q.normalized()});
    height += p.z();
  }
  Runner runner(maker.world());
  runner.run(5);
  for (std::size_t i = 5; i < 5 + kCubes; ++i) EXPECT_TRUE(runner[i].asleep) << i;
  EXPECT_LT(runner.state.energy.sum, 0.005 * 0.027 * kGravity * height);
}

// Five cubes that are meshes of twelve triangles: ODE's triangle meshes meet only where triangles cross, and flew apart
// at 83 m/s.
TEST(MeshCubes, StackRestsAndSleeps) {
  WorldMaker maker;
  maker.table();
  const auto mesh = std::make_shared<const TriMesh>(twelveTriangles());
  for (int i = 0; i < 5; ++i) {
    maker.add(MeshRef{}, {{0.002 * i, 0, kEdge * (i + 0.5)}, Quat::Identity()},
              {0.2, Vec3::Zero(), boxInertia(0.2, kCube)}, {}, mesh);
  }
  Runner runner(maker.world());
  runner.run(2);
  for (std::size_t i = 1; i <= 5; ++i) {
    EXPECT_TRUE(runner[i].asleep) << i;
    EXPECT_NEAR(runner[i].X_WB_end.p.z(), kEdge * (static_cast<double>(i) - 0.5), 1e-5);
  }
}

TEST(Capsule, LyingRestsAndSleeps) {
  WorldMaker maker;
  maker.table().add(Capsule{0.02, 0.1}, {{0, 0, 0.021}, turn(radians(90), Vec3::UnitX())},
                    {0.2, Vec3::Zero(), Vec3(2e-4, 2e-4, 4e-5).asDiagonal().toDenseMatrix()});
  Runner runner(maker.world());
  runner.run(2);
  EXPECT_TRUE(runner[1].asleep);
  EXPECT_LT((runner[1].X_WB_end.p - Vec3(0, 0, 0.02)).norm(), 1e-5);
}

// A body between two others of one shape falls as one: in the air nothing pushes.
TEST(Energy, NoneAppearsInFreeFallNorInAGrasp) {
  WorldMaker maker;
  maker.box(kCube, 0.1, {{0, 0, 1}, turn(0.3, {1, 2, 3})}).box(kCube, 0.2, {});
  Runner runner(maker.world());
  runner.bodies.setVelocity(0, {1, 0, 3}, {5, 20, 3});
  std::vector<ReferenceFinger> fingers = pinch(1, kEdge, 0.002, 2000, 1);
  for (int n = 0; n < 400; ++n) {
    for (ReferenceFinger& finger : fingers) {
      const double speed = 0.3 * std::cos(2 * std::numbers::pi * n * kStep);
      finger.v_WH = {0, 0, speed};
      finger.p_WH += kStep * finger.v_WH;
    }
    runner.step(exchangeOf(fingers, runner));
  }
  EXPECT_LT(runner.state.energy.sum, 1e-9) << "0.3 J move to and fro";
}

// Two cubes that start 4 mm inside each other are pushed apart: the upper one gains its rise in gravity, and no more than
// the bound on the speed of the push allows.
TEST(Energy, OfAnOverlapThatIsPushedApartIsCounted) {
  WorldMaker maker;
  maker.table().box(kCube, 0.1, {{0, 0, kEdge / 2 - 0.004}, Quat::Identity()});
  Runner runner(maker.world());
  double fastest = 0;
  for (int n = 0; n < 200; ++n) {
    runner.step();
    fastest = std::max(fastest, runner[1].v_WB.norm());
  }
  const double rise = 0.1 * kGravity * 0.004;
  EXPECT_GT(runner.state.energy.sum, 0.9 * rise);
  EXPECT_LE(fastest, OdeOptions{}.newton.max_push);
}

TEST(Overlap, IsPushedApartNoFasterThanTheBound) {
  for (const SolverKind solver : {SolverKind::kNewton, SolverKind::kSmallSteps}) {
    WorldMaker maker;
    maker.table().box({0.5, 0.5, 0.2}, 1, {{0, 0, 0.03}, Quat::Identity()});
    OdeOptions options;
    options.method.solver = solver;
    Runner runner(maker.world(), options);
    double fastest = 0;
    for (int n = 0; n < 100; ++n) {
      runner.step();
      fastest = std::max(fastest, runner[1].v_WB.norm());
    }
    EXPECT_GT(fastest, 0.2) << "but pushed apart";
    EXPECT_LE(fastest, 1.0);
  }
}

// A block on a slope below its friction angle does not creep: friction is a spring that remembers.
TEST(Friction, HoldsWithoutCreep) {
  for (const SolverKind solver : {SolverKind::kNewton, SolverKind::kSmallSteps}) {
    WorldMaker maker;
    maker.friction(0.6).gravity(turn(radians(25), Vec3::UnitY()) * Vec3(0, 0, -kGravity));
    maker.table().box(kCube, 0.1, {{0, 0, kEdge / 2}, Quat::Identity()});
    OdeOptions options = awake();
    options.method.solver = solver;
    Runner runner(maker.world(), options);
    runner.run(1);
    const Vec3 p = runner[1].X_WB_end.p;
    runner.run(10);
    EXPECT_LT((runner[1].X_WB_end.p - p).norm(), 1e-6) << "0.1 um/s";
  }
}

struct Shooting {
  double speed, thickness;
  bool plate_moves;
};
class Shot : public testing::TestWithParam<Shooting> {};

// Cubes, capsules, balls, coins and tiles shot at a thin plate, or hit by it, with spin, from any side: none passes.
TEST_P(Shot, DoesNotPassAThinPlate) {
  const auto [speed, thickness, plate_moves] = GetParam();
  std::mt19937 generator(11);
  std::normal_distribution<double> normal;
  int through = 0;
  for (int n = 0; n < unlessSanitized(1000, 50); ++n) {
    WorldMaker maker;
    maker.gravity(Vec3::Zero());
    const Vec3 plate(1, 1, thickness);
    const Pose X_plate{{0, 0, -thickness / 2}, Quat::Identity()};
    if (plate_moves) {
      maker.box(plate, 1000, X_plate);
    } else {
      maker.fixedBox(plate, X_plate);
    }
    const Quat q = Quat(normal(generator), normal(generator), normal(generator), normal(generator)).normalized();
    const double size = 0.01;
    const Pose start{{0, 0, 0.02 + 0.00025 * n}, q};
    const BodyInertia inertia{0.01, Vec3::Zero(), boxInertia(0.01, Vec3::Constant(size))};
    const std::array<Shape, 5> shapes{Box{Vec3::Constant(size)}, Capsule{size / 2, size}, Sphere{size / 2},
                                      Cylinder{size / 2, size / 10}, Box{{size, size, size / 10}}};
    maker.add(shapes[static_cast<std::size_t>(n % 5)], start, inertia);
    Runner runner(maker.world());
    const Vec3 spin = 20 * Vec3(normal(generator), normal(generator), normal(generator));
    runner.bodies.setVelocity(1, {0, 0, plate_moves ? 0 : -speed}, spin);
    if (plate_moves) runner.bodies.setVelocity(0, {0, 0, speed}, Vec3::Zero());
    for (int k = 0; k < 200 && runner.time * speed < 1; ++k) runner.step();
    const double above = (runner[1].X_WB_end.p - runner[0].X_WB_end.p).z();
    if (above < 0) ++through;
  }
  EXPECT_EQ(through, 0);
}
INSTANTIATE_TEST_SUITE_P(AtAFixedPlate, Shot,
                         testing::Values(Shooting{0.5, 0.0005, false}, Shooting{2, 0.0005, false},
                                         Shooting{20, 0.0005, false}, Shooting{20, 0.1, false}));
INSTANTIATE_TEST_SUITE_P(ByAMovingPlate, Shot,
                         testing::Values(Shooting{0.5, 0.0005, true}, Shooting{2, 0.0005, true},
                                         Shooting{20, 0.0005, true}, Shooting{20, 0.1, true}));

}  // namespace
}  // namespace presa::ode
