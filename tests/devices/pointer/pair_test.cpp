// The pair alone, against simple walls.
#include "devices/pointer/pair.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "devices/hand/finger_plant.h"

namespace presa::pointer {
namespace {

constexpr double kPeriod = 1e-3, kRadius = 0.008, kSpan = 0.12, kGrip = 6, kPush = 10;
constexpr double kOpenHalf = kSpan / 2 + kRadius;
const FingerImpedance kFinger{.mass = 0.1, .stiffness = 300, .damping = 8};

/// Two fingers at 1 kHz around a fixed body of half width `half`, with a wall of `stiffness` [N/m] on each side.
struct Bench {
  explicit Bench(double half = -1, double stiffness = 1000) : half_width(half), wall(stiffness) {
    for (const auto side : {Pair::kThumb, Pair::kIndex}) {
      pair.add(side, kFinger.stiffness);
      plants[side].reset(pair.start(side));
    }
  }
  void run(double seconds) {
    for (const auto ticks = static_cast<std::uint64_t>(std::lround(seconds / kPeriod)), end = at + ticks; at < end;)
      step();
  }
  void step() {
    for (const auto side : {Pair::kThumb, Pair::kIndex}) {
      const HandPush push = pair.live(side, {at, static_cast<double>(at) * kPeriod, kPeriod});
      plants[side].step(push.p_WT, push.v_WT, felt[side]);
    }
    ++at;
    for (const auto side : {Pair::kThumb, Pair::kIndex}) {
      const double sign = side == Pair::kThumb ? -1 : 1;
      const double x = sign * this->x(side);
      const double depth = half_width < 0 ? 0 : std::max(0.0, half_width + kRadius - x);
      force[side] = wall * depth;
      felt[side] = Vec3(sign * force[side], 0, 0) + load;
      pair.feel(side, {plants[side].position(), plants[side].velocity(), felt[side]});
    }
  }
  void point(const Vec3& p, double closing, double yaw = 0) { pair.point({++sequence, p, yaw, closing, 0, 0, {}}); }
  double x(Pair::Side side) const { return plants[side].position().x(); }

  Pair pair{{.start = Vec3::Zero(), .fingertip = kRadius, .span = kSpan, .grip = kGrip, .push = kPush}};
  double half_width, wall;
  Vec3 load = Vec3::Zero();  ///< on each finger [N]
  std::array<double, 2> force{};
  std::array<FingerPlant, 2> plants{FingerPlant(kFinger, kPeriod), FingerPlant(kFinger, kPeriod)};
  std::array<Vec3, 2> felt{Vec3::Zero(), Vec3::Zero()};  ///< on each finger [N]
  std::uint64_t at = 0, sequence = 0;
};

// Closed form for a distance of 0.3 m: 0.05 s to full speed (12.5 mm), 0.5 m/s until 25 mm are left, then e^(-t / 0.05
// s). It is 1 mm away at 0.05 + (0.3 - 0.0125 - 0.025) / 0.5 + 0.05 ln 25 = 0.7359 s; tolerance: two ticks of 1 ms.
TEST(PointerFollower, GoesWithBoundedSpeedAndNeverTooFar) {
  Follower<Vec3> follower(Vec3::Zero(), Pair::kSpeed, Pair::kArrive);
  const Vec3 goal(0.18, -0.24, 0);
  double near_at = -1;
  Vec3 rate = Vec3::Zero();
  for (int i = 1; i <= 2000; ++i) {
    follower.step(goal, kPeriod);
    EXPECT_LE(follower.rate().norm(), Pair::kSpeed * (1 + 1e-12));
    EXPECT_LE((follower.rate() - rate).norm(), Pair::kSpeed / Pair::kArrive * kPeriod * (1 + 1e-9));
    rate = follower.rate();
    const double gone = follower.value().dot(goal) / goal.norm();
    EXPECT_LE(gone, goal.norm() + 1e-12);
    if (near_at < 0 && goal.norm() - gone < 1e-3) near_at = i * kPeriod;
  }
  EXPECT_NEAR(near_at, 0.7359, 0.002);
  EXPECT_LT((follower.value() - goal).norm(), 1e-9);
}

// Hand spring and wall spring in series, k k_w / (k + k_w) times the commanded depth, bounded by the grip. After five
// seconds the damping leaves an error of 1e-6 N.
TEST(PointerPair, PressesAsTheSpringsSayAndNeverMoreThanItsGrip) {
  for (const double half_width : {0.005, 0.02, 0.035, 0.05}) {
    for (const double closing : {0.3, 0.5, 0.7, 0.85, 1.0}) {
      Bench bench(half_width);
      bench.point(Vec3::Zero(), closing);
      bench.run(5);
      const double wanted = kOpenHalf - closing * (kOpenHalf + kGrip / kFinger.stiffness);
      const double depth = std::max(0.0, half_width + kRadius - wanted);
      const double series = kFinger.stiffness * bench.wall / (kFinger.stiffness + bench.wall);
      for (const double force : bench.force) EXPECT_NEAR(force, std::min(kGrip, series * depth), 1e-6) << closing;
    }
  }
}

// For any jump of the mouse, a fingertip arrives with at most the speeds of hand, turn and grip together, so the force
// at a wall of 1 N/mm rises by at most 0.85 N per millisecond.
TEST(PointerPair, AJumpOfTheMouseIsNoJumpOfForce) {
  Bench bench(0.035);
  double max = 0;
  for (int i = 0; i < 4000; ++i) {
    if (i % 400 == 0) bench.point(Vec3(i % 800 == 0 ? 0.5 : -0.5, 0.3, 0), i % 1200 == 0 ? 1 : 0, i);
    const auto before = bench.force;
    bench.step();
    for (std::size_t f = 0; f < 2; ++f) max = std::max(max, bench.force[f] - before[f]);
  }
  EXPECT_GT(max, 0.05);  // the wall was touched
  EXPECT_LT(max, bench.wall * (Pair::kSpeed + Pair::kTurn * kOpenHalf + Pair::kClose) * kPeriod);
}

TEST(PointerPair, FingertipsStopAtEachOther) {
  Bench bench;
  bench.point(Vec3(0.05, 0, 0), 1);
  bench.run(3);
  EXPECT_NEAR(bench.x(Pair::kThumb), 0.05 - kRadius, 1e-6);
  EXPECT_NEAR(bench.x(Pair::kIndex), 0.05 + kRadius, 1e-6);
}

// A load causes a displacement of force over stiffness; a turn of the pair turns the line between the fingertips.
TEST(PointerPair, YieldsToALoadAndTurns) {
  Bench bench;
  bench.load = {0, 0, -2};
  bench.point(Vec3(0, 0, 0.1), 0, std::numbers::pi / 2);
  bench.run(5);
  EXPECT_LT((bench.plants[Pair::kThumb].position() - Vec3(0, -kOpenHalf, 0.1 - 2 / 300.0)).norm(), 1e-6);
  EXPECT_LT((bench.plants[Pair::kIndex].position() - Vec3(0, kOpenHalf, 0.1 - 2 / 300.0)).norm(), 1e-6);
}

// Pointing far into a fixed obstacle, each finger pushes with the bound, independent of the distance.
TEST(PointerPair, PushesWithABoundedForce) {
  for (const double far : {0.2, 5.0}) {
    Bench bench;
    bench.point(Vec3(0, 0, -far), 0);
    double force = 0;
    for (int i = 0; i < 5000; ++i) {
      force = 1000 * std::max(0.0, -0.01 - bench.plants[Pair::kThumb].position().z());
      bench.load = {0, 0, force};
      bench.step();
    }
    EXPECT_NEAR(force, kPush, 1e-3);  // the force is one tick old, but the pair is at rest
  }
}

TEST(PointerPair, BelievesNoPointerThatIsNotANumber) {
  Bench bench;
  bench.point(Vec3(0.1, 0, 0), 0);
  bench.point(Vec3(NAN, 0, 0), NAN, NAN);
  bench.run(2);
  EXPECT_NEAR(bench.x(Pair::kThumb), 0.1 - kOpenHalf, 1e-6);
}

}  // namespace
}  // namespace presa::pointer
