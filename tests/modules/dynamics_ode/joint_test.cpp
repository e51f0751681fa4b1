#include <numeric>

#include "tests/modules/dynamics_ode/support.h"

namespace presa::ode {
namespace {

constexpr std::size_t kWorld = Joint::kWorld;

// A rod that hangs from the world by a hinge about y at its upper end.
struct Pendulum {
  static constexpr double kLength = 0.3, kMass = 0.3;
  explicit Pendulum(double angle, JointType type = JointType::kHinge, double step = kStep) : h(step) {
    const Vec3 size(0.02, 0.02, kLength), p_BJ(0, 0, kLength / 2);
    const Quat q = turn(angle, Vec3::UnitY());
    WorldMaker maker;
    maker.box(size, kMass, {q * Vec3(0, 0, -kLength / 2), q});
    maker.joint(type, p_BJ, type == JointType::kBall ? std::vector<Vec3>{} : std::vector<Vec3>{Vec3::UnitY()});
    runner = std::make_unique<Runner>(maker.world(), awake());
    inertia = boxInertia(kMass, size);
    about_joint = inertia(1, 1) + kMass * kLength * kLength / 4;
  }
  double angle() const {
    const Vec3 down = (*runner)[0].X_WB_end.q * -Vec3::UnitZ();
    return std::atan2(-down.x(), -down.z());
  }
  double potential() const { return kMass * kGravity * (*runner)[0].X_WB_end.p.z(); }
  // Velocities belong to half steps; the energy at the pose between two is their product.
  double kinetic(const BodyMotion& a, const BodyMotion& b) const {
    return kMass * a.v_WB.dot(b.v_WB) / 2 + inertia(1, 1) * a.w_WB.dot(b.w_WB) / 2;
  }
  std::unique_ptr<Runner> runner;
  Mat3 inertia;
  double about_joint = 0, h;
};

// Complete elliptic integral of the first kind by the arithmetic-geometric mean.
double ellipticK(double k) {
  double a = 1, b = std::sqrt(1 - k * k);
  for (int i = 0; i < 40; ++i) {
    const double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
  }
  return EIGEN_PI / 2 / a;
}

TEST(Joint, PendulumKeepsPeriodAndEnergyForAMinute) {
  for (const double degree : {5.0, 60.0, 120.0}) {
    const double start = radians(degree);
    Pendulum pendulum(start);
    const double small = std::sqrt(pendulum.about_joint / (Pendulum::kMass * kGravity * Pendulum::kLength / 2));
    const double period = 4 * small * ellipticK(std::sin(start / 2));
    double before = pendulum.angle(), first = -1, last = 0, lowest = 1e9, highest = -1e9;
    int crossings = 0;
    Runner& runner = *pendulum.runner;
    BodyMotion last_motion;
    double potential = pendulum.potential();
    const double swing = Pendulum::kMass * kGravity * Pendulum::kLength / 2 * (1 - std::cos(start));
    for (int i = 0; i < 12000; ++i) {
      runner.step();
      if (i > 0) {
        const double energy = pendulum.kinetic(last_motion, runner[0]) + potential;
        lowest = std::min(lowest, energy);
        highest = std::max(highest, energy);
      }
      last_motion = runner[0];
      potential = pendulum.potential();
      const double angle = pendulum.angle();
      if (before < 0 && angle >= 0) {
        last = runner.time - kStep * angle / (angle - before);
        if (first < 0) {
          first = last;
        } else {
          ++crossings;
        }
      }
      before = angle;
    }
    const double measured = (last - first) / crossings;
    std::printf("%g deg: period %.6f of %.6f: %+.4f %%; energy %.2e .. %.2e of swing %.4g\n", degree, measured, period,
                100 * (measured / period - 1), (highest - lowest) / swing, lowest, swing);
    EXPECT_NEAR(measured / period, 1, 5e-4);
    EXPECT_LT((highest - lowest) / swing, 1e-4);
  }
}

TEST(Joint, HingeHoldsAHundredNewtonsForAMinute) {
  WorldMaker maker;
  maker.box({0.3, 0.2, 0.02}, 1, {{0.15, 0, 0}, Quat::Identity()});
  maker.joint(JointType::kHinge, {-0.15, 0, 0}, {Vec3::UnitY()});
  World world = *maker.world();
  world.scene.bodies[0].force_W = {0, 100, 0};  // along the axis, with a moment of 15 N m across it
  Runner runner(std::make_shared<World>(world), awake());
  runner.bodies.setVelocity(0, Vec3::Zero(), Vec3::Zero());
  double gap = 0, tilt = 0;
  for (int i = 0; i < 12000; ++i) {
    runner.step();
    const Pose X_WB = runner[0].X_WB_end;
    gap = std::max(gap, (X_WB * Vec3(-0.15, 0, 0)).norm());
    tilt = std::max(tilt, degrees(std::acos(std::min(1.0, (X_WB.q * Vec3::UnitY()).y()))));
  }
  std::printf("gap %.3g mm, tilt %.3g deg\n", 1e3 * gap, tilt);
  EXPECT_LT(gap, 1e-5);
  EXPECT_LT(tilt, 0.01);
}

// A chain of ten links with a weight a thousand times as heavy at its end.
TEST(Joint, ChainWithAHeavyEndHangsStill) {
  WorldMaker maker;
  const double length = 0.04;
  for (int i = 0; i < 10; ++i) {
    maker.box({0.01, 0.01, length}, 0.001, {{0, 0, -(i + 0.5) * length}, Quat::Identity()});
    maker.joint(JointType::kBall, {0, 0, length / 2}, {}, i == 0 ? kWorld : static_cast<std::size_t>(i - 1));
  }
  maker.box(Vec3::Constant(0.05), 1, {{0, 0, -10 * length - 0.025}, Quat::Identity()});
  maker.joint(JointType::kBall, {0, 0, 0.025}, {}, 9);
  Runner runner(maker.world(), awake());
  const double start = runner[10].X_WB_end.p.z();
  double moved = 0;
  for (int i = 0; i < 2000; ++i) {
    runner.step();
    moved = std::max(moved, std::abs(runner[10].X_WB_end.p.z() - start));
  }
  std::printf("moved %.3g mm\n", 1e3 * moved);
  EXPECT_LT(moved, 1e-6);
}

}  // namespace
}  // namespace presa::ode
