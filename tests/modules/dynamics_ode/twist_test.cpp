// The dynamics' side of torsional friction that an oriented tool feels. Oracle: a flywheel (a cube without gravity), worked
// out by hand; the haptic side is imitated at the start of every step.
#include <algorithm>

#include "tests/modules/dynamics_ode/support.h"

namespace presa::ode::twist {
namespace {

constexpr double kMass = 0.2, kInertia = kMass * kEdge * kEdge / 6;  // [kg], [kg m^2]
constexpr double kStiffness = 1000, kDepth = 0.002, kTorsion = 0.003, kMu = 0.8;
constexpr double kTwistStiffness = 9.0 / 8 * kStiffness * kTorsion * kTorsion;  // [N m/rad]
constexpr double kBound = kTorsion * kMu * kStiffness * kDepth;                 // [N m]

/// A cube between two tools without friction along the surface of which one turns about x; `impulse` sums the torque that
/// it feels, counted around its sample.
class Turned {
 public:
  explicit Turned(DynamicsSettings::Coupling coupling = DynamicsSettings::Coupling::kSoft)
      : run_(world(), options(coupling)), fingers_(pinch(0, kEdge, kDepth, kStiffness, kMu)) {}

  void step(double spin) {
    ContactExchange exchange = exchangeOf(fingers_, run_);
    FingerContact& tool = exchange.fingers[0];
    const double body = 2 * std::atan2(run_[0].X_WB_end.q.x(), run_[0].X_WB_end.q.w());
    twist_ = std::clamp(twist_ + spin * kStep - std::remainder(body - body_, 2 * std::numbers::pi),
                        -kBound / kTwistStiffness, kBound / kTwistStiffness);
    body_ = body;
    tool.twist = twist_;
    tool.twist_stiffness = kTwistStiffness;
    tool.spin = spin;
    tool.twist_slips = std::abs(twist_) >= kBound / kTwistStiffness;
    exchange.fingers[1].twist_stiffness = 1e-12;  // oriented, too, and as good as slippery
    run_.step(exchange);
  }
  double w() const { return run_[0].w_WB.x(); }
  double twist() const { return twist_; }

 private:
  static std::shared_ptr<const World> world() {
    WorldMaker maker;
    maker.gravity(Vec3::Zero()).box({kEdge, kEdge, kEdge}, kMass, {});
    auto world = std::make_shared<World>(*maker.world());
    world->scene.devices.resize(2);
    for (Material& material : world->scene.materials) material.torsional_radius = kTorsion;
    return world;
  }
  static OdeOptions options(DynamicsSettings::Coupling coupling) {
    OdeOptions options = awake();
    options.method.coupling = coupling;
    return options;
  }
  Runner run_;
  std::vector<ReferenceFinger> fingers_;
  double twist_ = 0, body_ = 0;
};

// Faster than friction can follow, the tool slips and drives the cube like a flywheel under a constant torque.
TEST(Twist, DrivesAFlywheelByItsFriction) {
  Turned cube;
  for (int n = 0; n < 10; ++n) cube.step(100);  // winds the spring up
  const double begin = cube.w();
  const int steps = 50;
  for (int n = 0; n < steps; ++n) cube.step(100);
  const double expected = kBound / kInertia * steps * kStep;
  ASSERT_LT(begin + expected, 100);
  EXPECT_NEAR(cube.w() - begin, expected, 0.01 * expected);  // the grip sways by 0.1 % and bounds the torque
}

// A tool that turns slowly takes the cube along, whatever the coupling: the spring ends unwound.
TEST(Twist, TakesTheBodyAlong) {
  Turned cube;
  for (int n = 0; n < 8000; ++n) cube.step(1);
  EXPECT_NEAR(cube.w(), 1, 1e-3);
  EXPECT_LT(std::abs(cube.twist()), 0.02 * kBound / kTwistStiffness);
}

// With explicit forces the first step accelerates the cube by k * twist.
TEST(Twist, IsAForceOfOneStepWithExplicitCoupling) {
  Turned cube(DynamicsSettings::Coupling::kExplicit);
  cube.step(1);
  EXPECT_NEAR(cube.w(), kTwistStiffness * cube.twist() / kInertia * kStep, 1e-9);
}

}  // namespace
}  // namespace presa::ode::twist
