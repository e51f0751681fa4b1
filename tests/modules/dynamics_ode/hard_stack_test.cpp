#include <algorithm>

#include "tests/modules/dynamics_ode/support.h"
#include "tests/support/effort.h"

// Stacks that are hard for iterative solvers, at 200 Hz. Penetration is computed from the heights of face-to-face
// boxes, exactly and independently of the engine. Bound: 0.5 mm, half of a visible depth.
namespace presa::ode {
namespace {

constexpr double kMaxPenetration = 5e-4;

class MassRatio : public testing::TestWithParam<double> {};

// A heavy box on a light one for 30 s. ODE's iterative solver at 5 ms collapses from 1:100 on.
TEST_P(MassRatio, HeavyStandsOnLight) {
  const double light = 0.1;
  WorldMaker maker;
  maker.table().box(Vec3::Constant(kEdge), light, {{0, 0, kEdge / 2}, Quat::Identity()});
  maker.box(Vec3::Constant(kEdge), light * GetParam(), {{0, 0, 1.5 * kEdge}, Quat::Identity()});
  Runner runner(maker.world(), awake());
  for (int second = 0; second < unlessSanitized(30, 3); ++second) {
    runner.run(1);
    ASSERT_LT(kEdge / 2 - runner[1].X_WB_end.p.z(), kMaxPenetration);
    ASSERT_LT(kEdge - (runner[2].X_WB_end.p.z() - runner[1].X_WB_end.p.z()), kMaxPenetration);
    ASSERT_LT((runner[2].X_WB_end.p - Vec3(0, 0, 1.5 * kEdge)).norm(), 1e-3) << "it walked";
  }
  EXPECT_EQ(runner.bodies.fallbackSteps(), 0U);
}
INSTANTIATE_TEST_SUITE_P(OneTo, MassRatio, testing::Values(10.0, 100.0, 1000.0),
                         [](const auto& param) { return std::to_string(static_cast<int>(param.param)); });

// Each block starts 1 um inside the one below, because exact contact would depend on rounding.
std::shared_ptr<const World> tower(int blocks, bool turned) {
  WorldMaker maker;
  maker.table();
  for (int i = 0; i < blocks; ++i) {
    const double z = kEdge * (i + 0.5) - 1e-6 * (i + 1);
    maker.box(Vec3::Constant(kEdge), 0.1, {{0, 0, z}, turn(turned ? 0.15 * i : 0, Vec3::UnitZ())});
  }
  return maker.world();
}

// A soft fingertip on either side of body 1, modelled as two points 4 cm apart: on two single points a tower of ten
// blocks would physically tip about their line.
std::vector<ReferenceFinger> softPinch(const Vec3& centre, double stiffness, double depth) {
  std::vector<ReferenceFinger> fingers;
  for (const double y : {-0.02, 0.02}) {
    for (const ReferenceFinger& finger : pinch(1, kEdge, depth, stiffness, 0.8)) {
      fingers.push_back(finger);
      for (Vec3* p : {&fingers.back().p_BC, &fingers.back().p_BP, &fingers.back().p_WH}) p->y() += y;
      fingers.back().p_WH += centre;
      fingers.back().damping = 10;
    }
  }
  return fingers;
}

double deepest(const Runner& runner, std::size_t blocks) {
  double worst = kEdge / 2 - runner[1].X_WB_end.p.z();
  for (std::size_t i = 2; i <= blocks; ++i) {
    const Pose& below = runner[i - 1].X_WB_end;
    worst = std::max(worst, kEdge - (below.q.conjugate() * (runner[i].X_WB_end.p - below.p)).z());
  }
  return worst;
}

double farthestFrom(const Runner& runner, const std::vector<Vec3>& places) {
  double worst = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    worst = std::max(worst, (runner[i + 1].X_WB_end.p - places[i]).norm());
  }
  return worst;
}

TEST(Tower, OfTenStandsThirtySeconds) {
  for (const bool turned : {false, true}) {
    Runner runner(tower(10, turned), awake());
    std::vector<Vec3> places;
    for (std::size_t i = 1; i <= 10; ++i) places.push_back(runner[i].X_WB_end.p);
    for (int second = 0; second < unlessSanitized(30, 3); ++second) {
      runner.run(1);
      ASSERT_LT(deepest(runner, 10), kMaxPenetration);
      ASSERT_LT(farthestFrom(runner, places), 1e-3) << turned;
    }
  }
}

// Two fingertips of 10 N/mm grip the lowest of ten blocks with 20 N, carry the tower up 5 cm in a second, and hold it.
// In the air it is carried by friction only: a solver that bounds friction by the normal forces of a solve without
// friction gives the blocks none, and they separate.
TEST(Tower, OfTenGrippedAtTheLowestIsCarried) {
  const double k = 5000;
  for (const bool turned : {false, true}) {
    Runner runner(tower(10, turned), awake());
    const Vec3 centre = runner[1].X_WB_end.p;
    std::vector<ReferenceFinger> fingers = softPinch(centre, k, 0.002);
    const std::vector<ReferenceFinger> start = fingers;
    for (int n = 0; n < 800; ++n) {
      const double s = std::clamp(runner.time - 0.5, 0.0, 1.0);
      for (std::size_t f = 0; f < 4; ++f) {
        fingers[f].p_WH = start[f].p_WH + 0.05 * s * s * (3 - 2 * s) * Vec3::UnitZ();
        fingers[f].v_WH = 0.05 * 6 * s * (1 - s) * Vec3::UnitZ();
      }
      runner.step(exchangeOf(fingers, runner));
      for (std::size_t i = 2; i <= 10; ++i) {
        const Pose& below = runner[i - 1].X_WB_end;
        const Vec3 p = below.q.conjugate() * (runner[i].X_WB_end.p - below.p);
        ASSERT_NEAR(p.z(), kEdge, kMaxPenetration) << n << " block " << i;
        ASSERT_LT(p.head<2>().norm(), 1e-3) << n << " block " << i << " shifted";
      }
    }
    // four springs sag under the weight of ten blocks
    const double sag = 10 * 0.1 * kGravity / (4 * k);
    EXPECT_NEAR(runner[1].X_WB_end.p.z(), centre.z() + 0.05 - sag, 0.05 * sag) << turned;
  }
}

// 125 cubes poured into a bin come to rest. One that topples late may still be fast, so the median speed is tested.
TEST(Heap, Of125CubesSettles) {
  WorldMaker maker;
  maker.table();
  for (int side = 0; side < 4; ++side) {
    const double out = (side % 2 == 0 ? 1 : -1) * 0.2;
    const Vec3 size = side < 2 ? Vec3(0.05, 1, 2) : Vec3(1, 0.05, 2);
    maker.fixedBox(size, {side < 2 ? Vec3(out, 0, 0.9) : Vec3(0, out, 0.9), Quat::Identity()});
  }
  constexpr int kCubes = unlessSanitized(125, 25);
  for (int i = 0; i < kCubes; ++i) {
    const Vec3 cell(i % 5 - 2, i / 5 % 5 - 2, i / 25 + 0.6);
    maker.box(Vec3::Constant(kEdge), 0.1, {0.062 * cell, turn(0.7 * i, {1, 1.0 * (i % 3), 1.0 * (i % 5)})});
  }
  Runner runner(maker.world(), awake());
  runner.run(3);
  double deepest_contact = 0;
  std::vector<double> speeds;
  for (const BodyContact& contact : runner.bodies.contacts())
    deepest_contact = std::max(deepest_contact, contact.depth);
  for (std::size_t i = 5; i < 5 + kCubes; ++i) {
    EXPECT_LT(runner[i].X_WB_end.p.head<2>().cwiseAbs().maxCoeff(), 0.2);
    EXPECT_GT(runner[i].X_WB_end.p.z(), 0.02);
    speeds.push_back(runner[i].v_WB.norm());
  }
  RecordProperty("deepest_um", static_cast<int>(1e6 * deepest_contact));
  std::nth_element(speeds.begin(), speeds.begin() + kCubes / 2, speeds.end());
  RecordProperty("median_um_s", static_cast<int>(1e6 * speeds[kCubes / 2]));
  EXPECT_LT(deepest_contact, 2e-3);
  EXPECT_LT(speeds[kCubes / 2], 0.005);
  EXPECT_EQ(runner.bodies.faults().count, 0U);
}

// A finger of 10 N/mm presses a 1 g cube on a pile of 40 by 0.5 mm. By Newton's method it feels 5 N less 0.2 %, and the
// force trembles by 0.2 %; in small steps the pile yields by 8 % of that and trembles by 0.5 %; with ODE's iterative
// solver and its sub-steps it trembles by 10 %.
TEST(Heap, FingerOnALargeIslandHoldsALightCube) {
  using Solver = DynamicsSettings::Solver;
  const auto press = [](Solver solver) {
    WorldMaker maker;
    maker.table();
    maker.box(Vec3::Constant(kEdge), 0.001, {{0, 0, 2.5 * kEdge - 3e-6}, Quat::Identity()});
    for (int i = 0; i < 40; ++i) {
      const double layer = i / 20;
      maker.box(Vec3::Constant(kEdge), 0.1,
                {{kEdge * (i % 5 - 2), kEdge * (i / 5 % 4 - 2), kEdge * (layer + 0.5) - 1e-6 * (layer + 1)},
                 Quat::Identity()});
    }
    OdeOptions options = awake();
    options.method.solver = solver;
    Runner runner(maker.world(), options);
    std::vector<ReferenceFinger> fingers{{1, {0, 0, kEdge / 2}, Vec3::UnitZ()}};
    fingers[0].stiffness = 10000;
    fingers[0].damping = 1;
    fingers[0].p_WH = runner[1].X_WB_end.p + fingers[0].p_BP - 0.0005 * Vec3::UnitZ();
    double min = 1e300, max = 0;
    constexpr int kSteps = unlessSanitized(150, 10), kSettling = unlessSanitized(100, 5);
    for (int n = 0; n < kSteps; ++n) {
      runner.step(exchangeOf(fingers, runner));
      if (n < kSettling) continue;
      const double force = runner.bodies.fingerForce(0).norm();
      min = std::min(min, force);
      max = std::max(max, force);
    }
    return std::pair((max - min) / max, (max + min) / 2);
  };
  const auto [newton, newton_force] = press(Solver::kNewton);
  const auto [steps, steps_force] = press(Solver::kSmallSteps);
  const auto [ode, ode_force] = press(Solver::kIterative);
  RecordProperty("chatter_percent",
                 std::to_string(100 * newton) + ", " + std::to_string(100 * steps) + ", " + std::to_string(100 * ode));
  if (unlessSanitized(false, true)) return;  // too short to settle
  EXPECT_NEAR(newton_force, 5, 0.05);
  EXPECT_NEAR(steps_force, 5, 0.5);
  EXPECT_LT(newton, 0.005);
  EXPECT_LT(steps, 0.01);
  EXPECT_LT(2 * steps, ode);
}

}  // namespace
}  // namespace presa::ode
