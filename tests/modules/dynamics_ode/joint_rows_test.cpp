#include <functional>

#include "modules/dynamics_ode/rotation.h"
#include "tests/modules/dynamics_ode/pendulum.h"
#include "tests/modules/dynamics_ode/support.h"
#include "tests/support/effort.h"

// Joints in islands of several: the general rows with Newton's method, not the steps for one joint alone.
namespace presa::ode {
namespace {

using JointRows = testing::Test;

struct Case {
  JointType type;
  std::vector<Vec3> axes;  // in the frame of the body
};

const std::vector<Case>& kinds() {
  static const std::vector<Case> cases{{JointType::kFixed, {}},
                                       {JointType::kHinge, {Vec3::UnitY()}},
                                       {JointType::kSlider, {Vec3::UnitX()}},
                                       {JointType::kBall, {}},
                                       {JointType::kUniversal, {Vec3::UnitZ(), Vec3::UnitX()}},
                                       {JointType::kPrismaticRotary, {Vec3::UnitX(), Vec3::UnitY()}}};
  return cases;
}

/// A plate on a joint to the world, and a ball on a joint to its far end, so that the island has two joints. Stops at 0
/// hold the axes.
struct Loaded {
  static constexpr double kReach = 0.15;
  Loaded(const Case& of, const Vec3& force_W, const OdeOptions& options = awake()) : kind(of) {
    WorldMaker maker;
    maker.gravity(Vec3::Zero()).box({2 * kReach, 0.2, 0.02}, 1, {{kReach, 0, 0}, Quat::Identity()});
    Joint& joint = maker.joint(of.type, {-kReach, 0, 0}, of.axes);
    for (JointAxis& axis : joint.axes) axis.lower = axis.upper = 0;
    maker.ball(0.02, 0.1, {2 * kReach, 0, 0});
    maker.joint(JointType::kFixed, Vec3::Zero(), {}, 0);
    World world = *maker.world();
    world.scene.bodies[0].force_W = force_W;
    runner = std::make_unique<Runner>(std::make_shared<World>(world), options);
  }
  double gap() const {
    const Vec3 p = (*runner)[0].X_WB_end * Vec3(-kReach, 0, 0);
    return p.norm();
  }
  double tilt() const { return degrees(turnBetween(Quat::Identity(), (*runner)[0].X_WB_end.q).norm()); }
  double gapOfBall() const { return ((*runner)[1].X_WB_end.p - (*runner)[0].X_WB_end * Vec3(kReach, 0, 0)).norm(); }
  Case kind;
  std::unique_ptr<Runner> runner;
};

// 100 N at the middle of a plate of 0.3 m, along each direction, and with it 15 N m across. A ball is loaded along its arm
// only, where it stands. The largest error of the second 5 s is that of the first: it is steady.
TEST(JointRows, HoldAHundredNewtons) {
  for (const Case& kind : kinds()) {
    for (const Vec3& along : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY()), Vec3(Vec3::UnitZ())}) {
      if (kind.type == JointType::kBall && along.x() == 0) continue;  // it turns
      Loaded loaded(kind, 100 * along);
      std::array<double, 2> gap{}, tilt{};
      double ball = 0;
      for (int i = 0; i < 2000; ++i) {
        loaded.runner->step();
        const std::size_t part = i < 1000 ? 0 : 1;
        gap[part] = std::max(gap[part], loaded.gap());
        tilt[part] = std::max(tilt[part], loaded.tilt());
        ball = std::max(ball, loaded.gapOfBall());
      }
      const std::string which = std::string(nameOf(kind.type)) + " " + std::to_string(along.x()) + " " +
                                std::to_string(along.y()) + " " + std::to_string(along.z());
      EXPECT_LT(gap[0], 1e-5) << which;
      EXPECT_LT(tilt[0], 0.01) << which;
      EXPECT_LT(gap[1], gap[0] + 1e-9) << which;
      EXPECT_LT(tilt[1], tilt[0] + 1e-6) << which;
      EXPECT_LT(ball, 1e-5) << which;
    }
  }
}

// A pendulum of two bodies fixed to each other: period against the elliptic integral, energy at the turning points by
// their heights, as in Joint.PendulumKeepsPeriodAndEnergyForAMinute.
TEST(JointRows, PendulumOfTwoBodiesKeepsPeriodAndEnergyForAMinute) {
  const double length = 0.3, mass = 0.3, bob = 0.2;
  const Vec3 size(0.02, 0.02, length), small = Vec3::Constant(0.03);
  for (const JointType type : {JointType::kHinge, JointType::kBall, JointType::kUniversal}) {
    for (const double degree : {5.0, 60.0, 120.0}) {
      const double start = radians(degree);
      const Quat q = turn(start, Vec3::UnitY());
      WorldMaker maker;
      maker.box(size, mass, {q * Vec3(0, 0, -length / 2), q});
      std::vector<Vec3> axes;
      if (type == JointType::kHinge) axes = {Vec3::UnitY()};
      if (type == JointType::kUniversal) axes = {Vec3::UnitY(), Vec3::UnitX()};
      maker.joint(type, {0, 0, length / 2}, axes);
      maker.box(small, bob, {q * Vec3(0, 0, -length), q});
      maker.joint(JointType::kFixed, Vec3::Zero(), {}, 0);
      Runner runner(maker.world(), awake());
      const double arm = kGravity * (mass * length / 2 + bob * length);
      const double inertia = boxInertia(mass, size)(1, 1) + mass * length * length / 4 + boxInertia(bob, small)(1, 1) +
                             bob * length * length;
      const double period = 4 * std::sqrt(inertia / arm) * ellipticK(std::sin(start / 2));
      const Swing swung = swingOver(unlessSanitized(12000, 1500), kStep, [&] {
        runner.step();
        const Vec3 down = runner[0].X_WB_end.q * -Vec3::UnitZ();
        return std::pair(std::atan2(-down.x(), -down.z()),
                         kGravity * (mass * runner[0].X_WB_end.p.z() + bob * runner[1].X_WB_end.p.z()));
      });
      const double swing = arm * (1 - std::cos(start));
      EXPECT_NEAR(swung.period / period, 1, 5e-4) << nameOf(type) << degree << " degrees";
      EXPECT_LT(swung.spread / swing, 1e-4) << nameOf(type) << degree << " degrees";
    }
  }
}

// A prismatic-rotary joint with a spring along its first axis and a motor about its second, which carries a body on a ball
// joint at its centre. Along: the trapezoidal rule with the mass of both. About: torque over inertia, then its speed.
TEST(JointRows, PrismaticRotarySwingsAlongAndTurnsAbout) {
  const double mass = 0.5, stiffness = 80, torque = 1e-3, speed = 6;
  const Vec3 size(0.08, 0.08, 0.04), along = Vec3(1, 2, 2).normalized(), about = Vec3::UnitZ();
  const Vec3 slide = (along - along.dot(about) * about).normalized();
  for (const Vec3& direction : {about, slide}) {
    WorldMaker maker;
    maker.gravity(Vec3::Zero()).box(size, mass, {});
    Joint& joint = maker.joint(JointType::kPrismaticRotary, Vec3::Zero(), {direction, about});
    joint.axes[0].stiffness = stiffness;
    joint.axes[1].speed = speed;
    joint.axes[1].max_force = torque;
    maker.box(Vec3::Constant(0.02), 0.1, {});
    maker.joint(JointType::kBall, Vec3::Zero(), {}, 0);
    Runner runner(maker.world(), awake());
    runner.bodies.setVelocity(0, 0.1 * direction, Vec3::Zero());
    runner.bodies.setVelocity(1, 0.1 * direction, Vec3::Zero());
    const double step = 2 * std::atan(kStep * std::sqrt(stiffness / (mass + 0.1)) / 2),
                 c = kStep * 0.1 / std::sin(step);
    const double inertia = boxInertia(mass, size)(2, 2);
    double worst = 0, aside = 0, slower = 0, tilt = 0;
    for (int n = 1; n <= 2000; ++n) {
      runner.step();
      const Vec3 p = runner[0].X_WB_end.p;
      worst = std::max(worst, std::abs(p.dot(direction) - c * std::sin(n * step)));
      aside = std::max(aside, (p - p.dot(direction) * direction).norm());
      const double expected = std::min(speed, n * kStep * torque / inertia);
      slower = std::max(slower, std::abs(runner[0].w_WB.dot(about) - expected));
      tilt = std::max(tilt, (runner[0].X_WB_end.q * about - about).norm());
    }
    EXPECT_LT(worst, 1e-5 * c);
    EXPECT_LT(aside, 1e-8);
    EXPECT_LT(slower, 1e-5 * speed);
    EXPECT_LT(tilt, 1e-7);
  }
}

// A universal joint that forces drive into the stops of both axes, one after the other and together: it rests at them.
TEST(JointRows, StopsOfAUniversalHoldBothAxes) {
  for (const double first : {-1.0, 0.0, 1.0}) {
    for (const double second : {-1.0, 0.0, 1.0}) {
      WorldMaker maker;
      maker.gravity(Vec3::Zero()).box({0.04, 0.04, 0.2}, 0.3, {{0, 0, -0.1}, Quat::Identity()});
      Joint& joint = maker.joint(JointType::kUniversal, {0, 0, 0.1}, {Vec3::UnitX(), Vec3::UnitY()});
      for (std::size_t i = 0; i < 2; ++i) {
        JointAxis& axis = joint.axes[i];
        axis.lower = radians(i == 0 ? -30 : -20);
        axis.upper = radians(i == 0 ? 40 : 25);
        axis.max_force = 0.5;
        axis.speed = 2 * (i == 0 ? first : second);
      }
      maker.box(kCube, 0.1, {{0, 0, -0.25}, Quat::Identity()});
      maker.joint(JointType::kFixed, Vec3::Zero(), {}, 0);
      const auto world = maker.world();
      Runner runner(world, awake());
      const JointFrames frames = framesOf(world->scene.joints[0], world->scene.bodies[0].X_WB, {});
      const auto at = [&](std::size_t i) {
        return degrees(positionOf(world->scene.joints[0], i, presa::poseOf(frames, runner[0].X_WB_end, {})));
      };
      double beyond = 0;
      for (int n = 0; n < 600; ++n) {
        runner.step();
        beyond = std::max({beyond, at(0) - 40, -30 - at(0), at(1) - 25, -20 - at(1)});
      }
      EXPECT_LT(beyond, 1e-5);
      EXPECT_NEAR(at(0), first > 0 ? 40 : 30 * first, 1e-4) << first << " " << second;
      EXPECT_NEAR(at(1), second > 0 ? 25 : 20 * second, 1e-4) << first << " " << second;
    }
  }
}

}  // namespace
}  // namespace presa::ode
