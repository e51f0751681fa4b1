#include <utility>

#include "tests/modules/dynamics_ode/support.h"

namespace presa::ode {
namespace {

struct Grip {
  double stiffness, mass;
};
class PinchedCube : public testing::TestWithParam<Grip> {};

// Two fingers fixed in space, 2 mm inside opposite faces, must press with k * depth each and hold the cube still, for
// every stiffness and down to 1 g, where an explicit penalty force is unstable. Start 0.1 mm off centre. A
// psychophysical grip force needs 0.1 %; rest means a speed below 1 um/s.
TEST_P(PinchedCube, IsHeldAtRestWithTheRenderedForce) {
  const auto [k, mass] = GetParam();
  Runner runner(WorldMaker().gravity(Vec3::Zero()).box(kCube, mass, {{1e-4, 0, 0}, turn(0.01, {0, 1, 1})}).world());
  std::vector<ReferenceFinger> fingers = pinch(0, kEdge, 0.002, k, 1);
  for (ReferenceFinger& finger : fingers) finger.damping = 0.2 * std::sqrt(k * mass);
  for (int n = 0; n < 1000; ++n) runner.step(exchangeOf(fingers, runner));
  const ContactExchange exchange = exchangeOf(fingers, runner);
  EXPECT_LT(runner[0].v_WB.norm(), 1e-6);
  EXPECT_LT(runner[0].w_WB.norm(), 1e-4);
  for (std::size_t f = 0; f < 2; ++f) {
    // the force on the body is the negative of the force on the finger
    EXPECT_LT((runner.bodies.fingerForce(f) + exchange.fingers[f].f_H_W).norm(), 1e-3 * k * 0.002);
    EXPECT_NEAR(-runner.bodies.fingerForce(f).dot(exchange.fingers[f].nhat_W), k * 0.002, 1e-3 * k * 0.002);
  }
  EXPECT_EQ(runner.bodies.faults().count, 0U);
  EXPECT_EQ(runner.bodies.fallbackSteps(), 0U);
}
INSTANTIATE_TEST_SUITE_P(StiffnessAndMass, PinchedCube,
                         testing::Values(Grip{500, 0.001}, Grip{500, 0.05}, Grip{500, 1}, Grip{2000, 0.001},
                                         Grip{2000, 0.05}, Grip{2000, 1}, Grip{10000, 0.001}, Grip{10000, 0.05},
                                         Grip{10000, 1}));

// The same grip with explicit penalty forces is unstable below m = h^2 K / 2 per axis, K = 2 k. Tested 10 % on either
// side.
TEST(ExplicitCoupling, IsUnstableBelowItsMassLimit) {
  const double k = 2000, limit = kStep * kStep * 2 * k / 4;
  const auto amplitude = [&](double mass) {
    OdeOptions options;
    options.method.coupling = DynamicsSettings::Coupling::kExplicit;
    WorldMaker maker;
    maker.gravity(Vec3::Zero())
        .add(Box{kCube}, {{1e-6, 0, 0}, Quat::Identity()}, {mass, Vec3::Zero(), 1e3 * Mat3::Identity()});
    Runner runner(maker.world(), options);
    std::vector<ReferenceFinger> fingers = pinch(0, kEdge, 0.002, k, 0);
    double worst = 0;
    for (int n = 0; n < 400; ++n) {
      runner.step(exchangeOf(fingers, runner));
      worst = std::max(worst, std::abs(runner[0].X_WB_end.p.x()));
    }
    return worst;
  };
  EXPECT_LT(amplitude(1.1 * limit), 1e-5);
  EXPECT_GT(amplitude(0.9 * limit), 1e-3);
}

// A cube held between two fingers sags by the tangential springs alone: m g / (2 k).
TEST(Finger, HeldCubeSagsByItsWeightOverTheTangentialStiffness) {
  const double k = 2000, mass = 0.1;
  Runner runner(WorldMaker().box(kCube, mass, {}).world());
  std::vector<ReferenceFinger> fingers = pinch(0, kEdge, 0.002, k, 1);
  for (ReferenceFinger& finger : fingers) finger.damping = 1;
  for (int n = 0; n < 2000; ++n) runner.step(exchangeOf(fingers, runner));
  const double sag = mass * kGravity / (2 * k);
  EXPECT_NEAR(-runner[0].X_WB_end.p.z(), sag, 1e-3 * sag);
  EXPECT_NEAR(runner.bodies.fingerForce(0).z(), mass * kGravity / 2, 1e-3 * mass * kGravity);
  // ... without creep
  const double before = runner[0].X_WB_end.p.z();
  for (int n = 0; n < 800; ++n) runner.step(exchangeOf(fingers, runner));
  EXPECT_NEAR(runner[0].X_WB_end.p.z(), before, 1e-9);
}

// Friction cone of a grip: two fingers with mu 0.5 pressing 4 N each carry a weight of 4 N. 2 % below, the cube stays
// (less than 0.5 mm in 5 s); 2 % above, it falls.
TEST(Finger, GripHoldsBelowTheConeAndSlipsAbove) {
  const double k = 2000, depth = 0.002, mu = 0.5;
  const auto fall = [&](double weight) {
    Runner runner(WorldMaker().box(kCube, weight / kGravity, {}).world());
    std::vector<ReferenceFinger> fingers = pinch(0, kEdge, depth, k, mu);
    for (ReferenceFinger& finger : fingers) {
      finger.slides = true;
      finger.damping = 20;
    }
    double settled = 0;
    for (int n = 0; n < 1100; ++n) {
      runner.step(exchangeOf(fingers, runner));
      if (n == 100) settled = runner[0].X_WB_end.p.z();
    }
    return settled - runner[0].X_WB_end.p.z();
  };
  const double limit = 2 * mu * k * depth;
  EXPECT_LT(fall(0.98 * limit), 5e-4);
  EXPECT_GT(fall(1.02 * limit), 5e-3);
}

// The cone is round: a finger sliding over a heavy cube exerts mu N in every direction.
TEST(Finger, SlippingForceIsMuTimesNormalForceInEveryDirection) {
  const double k = 2000, depth = 0.002, mu = 0.5;
  for (double heading = 0; heading <= 90; heading += 15) {
    // so heavy that it stays in place while the finger slides over it
    WorldMaker maker;
    maker.gravity(Vec3::Zero()).add(Box{kCube}, {}, {1e9, Vec3::Zero(), 1e9 * Mat3::Identity()});
    Runner runner(maker.world());
    std::vector<ReferenceFinger> fingers{{0, {0, 0, kEdge / 2}, Vec3::UnitZ()}};
    fingers[0].stiffness = k;
    fingers[0].mu_static = fingers[0].mu_dynamic = mu;
    fingers[0].slides = true;
    fingers[0].v_WH = 0.02 * Vec3(std::cos(radians(heading)), std::sin(radians(heading)), 0);
    const Vec3 start = fingers[0].p_BP - depth * Vec3::UnitZ();
    for (int n = 0; n < 200; ++n) {
      fingers[0].p_WH = start + runner.time * fingers[0].v_WH;
      runner.step(exchangeOf(fingers, runner));
    }
    const Vec3 f = runner.bodies.fingerForce(0);
    EXPECT_NEAR(f.z(), -k * depth, 1e-5 * k * depth);
    EXPECT_NEAR(f.head<2>().norm(), mu * k * depth, 1e-5 * k * depth) << heading;
    EXPECT_NEAR(degrees(std::atan2(f.y(), f.x())), heading, 1e-4);
  }
}

// A contact that sticks at the sample and is pulled past its static bound within the step slips in it: mu_d N, not mu_s N.
TEST(Finger, PulledPastTheStaticBoundSlipsWithinTheStep) {
  const double k = 1000, depth = 0.002;
  WorldMaker maker;
  maker.gravity(Vec3::Zero()).add(Box{kCube}, {}, {1e9, Vec3::Zero(), 1e9 * Mat3::Identity()});
  using Solver = DynamicsSettings::Solver;
  for (const Solver solver : {Solver::kAuto, Solver::kDirect, Solver::kIterative, Solver::kNewton}) {
    OdeOptions options;
    options.method.solver = solver;
    for (const auto& [pulled, force] : {std::pair(0.9, 0.9), std::pair(1.1, 0.5)}) {  // of the static bound
      Runner runner(maker.world(), options);
      std::vector<ReferenceFinger> fingers{{0, {0, 0, kEdge / 2}, Vec3::UnitZ()}};
      fingers[0].stiffness = k;
      fingers[0].mu_static = 1;
      fingers[0].mu_dynamic = 0.5;
      fingers[0].p_WH = fingers[0].p_BP - depth * Vec3(pulled, 0, 1);
      runner.step(exchangeOf(fingers, runner));
      // on the body, towards the HIP
      EXPECT_NEAR(-runner.bodies.fingerForce(0).x(), force * k * depth, 1e-5 * k * depth)
          << pulled << ", solver " << static_cast<int>(solver);
    }
  }
}

// Two fingers carry a 1 g cube through a 30 mm, 1 Hz sine, along and across the grip. Oracle: the two springs
// integrated in steps of 10 us (symplectic Euler). 0.05 mm is half of the perceptible difference.
TEST(Finger, MovingPairCarriesALightCubeLikeAFineIntegration) {
  const double k = 10000, mass = 0.001, d = 0.1 * std::sqrt(k * mass);
  for (const Vec3& direction : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY())}) {
    Runner runner(WorldMaker().gravity(Vec3::Zero()).box(kCube, mass, {}).world());
    std::vector<ReferenceFinger> fingers = pinch(0, kEdge, 0.002, k, 1);
    const std::vector<ReferenceFinger> rest = fingers;
    const auto hand = [](double t) { return 0.03 * std::sin(2 * std::numbers::pi * t); };
    const auto hand_speed = [](double t) { return 0.03 * 2 * std::numbers::pi * std::cos(2 * std::numbers::pi * t); };
    double x = 0, v = 0, t = 0, worst = 0;
    runner.bodies.setVelocity(0, hand_speed(0) * direction, Vec3::Zero());
    v = hand_speed(0);
    for (int n = 0; n < 400; ++n) {
      for (std::size_t f = 0; f < 2; ++f) {
        fingers[f].damping = d;
        fingers[f].p_WH = rest[f].p_WH + hand(runner.time) * direction;
        fingers[f].v_WH = hand_speed(runner.time) * direction;
      }
      runner.step(exchangeOf(fingers, runner));
      for (int i = 0; i < 500; ++i, t += 1e-5) {
        v += 1e-5 / mass * (2 * k * (hand(t) - x) + 2 * d * (hand_speed(t) - v));
        x += 1e-5 * v;
      }
      worst = std::max(worst, (runner[0].X_WB_end.p - x * direction).norm());
    }
    EXPECT_LT(worst, 5e-5);
    for (std::size_t f = 0; f < 2; ++f) {
      EXPECT_NEAR(-runner.bodies.fingerForce(f).dot(fingers[f].nhat_B), k * 0.002, 0.02 * k * 0.002);
    }
  }
}

// A fingertip larger than the body: when the body rotates, the proxy moves faster than the surface. An implicit step
// must include this, or light bodies flutter.
TEST(Finger, LightBodyThinnerThanTheFingertipStaysAtRest) {
  const double edge = 0.004, k = 10000;
  Runner runner(
      WorldMaker().gravity(Vec3::Zero()).box({edge, edge, edge}, 0.001, {{0, 0, 1e-5}, turn(0.01, {0, 1, 1})}).world());
  std::vector<ReferenceFinger> fingers = pinch(0, edge, 0.0005, k, 1);
  for (int n = 0; n < 1000; ++n) runner.step(exchangeOf(fingers, runner));
  EXPECT_LT(runner[0].v_WB.norm(), 1e-6);
  EXPECT_LT(runner[0].w_WB.norm(), 1e-3);
}

// A sample older than the step is extrapolated with its velocity: a finger moving with its body at 0.2 m/s, sampled 4
// ms ago, must press with the same force as a current one.
TEST(Finger, OldSampleIsExtrapolatedWithItsVelocity) {
  const Vec3 v(0, 0, 0.2);
  const auto force = [&](double age) {
    WorldMaker maker;
    maker.gravity(Vec3::Zero()).add(Box{kCube}, {}, {1e9, Vec3::Zero(), 1e9 * Mat3::Identity()});
    Runner runner(maker.world());
    runner.bodies.setVelocity(0, v, Vec3::Zero());
    std::vector<ReferenceFinger> fingers{{0, {0, 0, -kEdge / 2}, -Vec3::UnitZ()}};
    fingers[0].p_WH = fingers[0].p_BP + Vec3(0.0005, 0, 0.002) - age * v;
    fingers[0].v_WH = v;
    ContactExchange exchange(1);
    exchange.time = -age;
    exchange.fingers[0] = fingers[0].contact({-age * v, Quat::Identity()});
    runner.step(exchange);
    return runner.bodies.fingerForce(0);
  };
  EXPECT_LT((force(0.004) - force(0)).norm(), 1e-9);
  EXPECT_NEAR(force(0).z(), 2, 1e-6);
  EXPECT_NEAR(force(0).x(), 0.5, 1e-6);
}

// A finger that accelerates into a body at rest. The force of a step is that at its end, k a t^2 / 2; less k a h^2 / 12,
// which the haptic side does not see. The first step does not know the acceleration.
TEST(Finger, IsExtrapolatedWithItsAcceleration) {
  constexpr double kStiffness = 1000, kAcceleration = 20;
  WorldMaker maker;
  maker.gravity(Vec3::Zero()).add(Box{kCube}, {}, {1e9, Vec3::Zero(), 1e9 * Mat3::Identity()});
  Runner runner(maker.world());
  ReferenceFinger finger(0, {0, 0, kEdge / 2}, Vec3::UnitZ());
  finger.stiffness = kStiffness;
  for (int n = 0; n < 4; ++n) {
    const double time = runner.time, end = time + kStep;
    finger.p_WH = finger.p_BP - kAcceleration * time * time / 2 * Vec3::UnitZ();
    finger.v_WH = -kAcceleration * time * Vec3::UnitZ();
    ContactExchange exchange(1);
    exchange.time = time;
    exchange.fingers[0] = finger.contact({});
    runner.step(exchange);
    const double depth = n == 0 ? 0 : kAcceleration * (end * end / 2 - kStep * kStep / 12);
    EXPECT_NEAR(-runner.bodies.fingerForce(0).z(), kStiffness * depth, 1e-6) << n;
  }
}

// A sticking proxy that reaches its static bound within the step slips there: from then on sliding friction is
// rendered, and the body gets no more than that. mu 0.8 and 0.6 at 2 N; displaced by 1.5 and by 1.7 mm at the end of
// the step.
TEST(Finger, SlipsInTheStepInWhichItsStaticBoundIsReached) {
  const auto friction = [](double end) {
    WorldMaker maker;
    maker.gravity(Vec3::Zero()).add(Box{kCube}, {}, {1e9, Vec3::Zero(), 1e9 * Mat3::Identity()});
    Runner runner(maker.world());
    ReferenceFinger finger(0, {0, 0, kEdge / 2}, Vec3::UnitZ());
    finger.p_WH = finger.p_BP - Vec3(0.0014, 0, 0.002);
    finger.v_WH = Vec3(-(end - 0.0014) / kStep, 0, 0);
    ContactExchange exchange(1);
    exchange.fingers[0] = finger.contact({});
    exchange.fingers[0].mode = ContactMode::kStick;
    exchange.fingers[0].friction_static = 0.8;
    exchange.fingers[0].friction_dynamic = 0.6;
    runner.step(exchange);
    const Vec3 force = runner.bodies.fingerForce(0);
    EXPECT_NEAR(-force.z(), 2, 1e-6);
    return -force.x();
  };
  EXPECT_NEAR(friction(0.0015), 1.5, 1e-6);
  EXPECT_NEAR(friction(0.0017), 0.6 * 2, 1e-6);
}

// Force of a finger with 2 N on a heavy cube, whose last sample has this age [N].
double forceAtAge(WorldMaker maker, double age) {
  maker.gravity(Vec3::Zero()).add(Box{kCube}, {}, {1e9, Vec3::Zero(), 1e9 * Mat3::Identity()});
  Runner runner(maker.world());
  std::vector<ReferenceFinger> fingers = pinch(0, kEdge, 0.002, 1000, 1);
  ContactExchange exchange = exchangeOf(fingers, runner);
  exchange.time = -age;
  runner.step(exchange);
  return runner.bodies.fingerForce(0).norm();
}

// With a tenth of the haptic rate the age limit is larger: two haptic periods plus the step being solved, 45 ms.
TEST(Finger, ThatIsReportedSeldomFadesLater) {
  const auto force = [](double age) { return forceAtAge(WorldMaker().rates(100, 40), age); };
  EXPECT_NEAR(force(0.044), 2, 1e-6);
  EXPECT_NEAR(force(0.055), 1, 1e-6);  // half of the fade time of 20 ms
  EXPECT_EQ(force(0.066), 0);
}

// A finger without new samples fades smoothly: full force up to 20 ms, none at 40 ms.
TEST(Finger, FadesWhenNoLongerReported) {
  const auto force = [](double age) { return forceAtAge(WorldMaker(), age); };
  EXPECT_NEAR(force(0.020), 2, 1e-9);
  EXPECT_NEAR(force(0.030), 1, 1e-9);
  EXPECT_EQ(force(0.040), 0);
  EXPECT_EQ(force(10), 0);
}

// Newton's third law: over any 0.1 s of a grasp the impulse in the object state equals the integral of the force
// rendered on the finger. A cube is gripped, lifted with acceleration and held; the force is rendered at 1 kHz against
// the interpolated pose, as on the haptic thread. Tolerance: 1 % of the window's impulse.
TEST(Finger, ImpulseOnTheBodyIsWhatTheFingerFelt) {
  const double k = 2000;
  Runner runner(WorldMaker().box(kCube, 0.2, {}).world());
  std::vector<ReferenceFinger> fingers = pinch(0, kEdge, 0.003, k, 1);
  const std::vector<ReferenceFinger> rest = fingers;
  constexpr int kTicks = 5, kWindow = 20;
  std::vector<std::array<Vec3, 2>> given, felt;
  std::array<Vec3, 2> sum{Vec3::Zero(), Vec3::Zero()};
  for (int n = 0; n < 400; ++n) {
    const auto lift = [](double t) { return 0.02 * (1 - std::cos(4 * t)); };
    for (std::size_t f = 0; f < 2; ++f) {
      fingers[f].damping = 5;
      fingers[f].p_WH = rest[f].p_WH + lift(runner.time) * Vec3::UnitZ();
      fingers[f].v_WH = 0.02 * 4 * std::sin(4 * runner.time) * Vec3::UnitZ();
    }
    const double begin = runner.time;
    runner.step(exchangeOf(fingers, runner));
    for (int tick = 0; tick < kTicks; ++tick) {
      const double t = begin + (tick + 0.5) * kStep / kTicks;
      for (std::size_t f = 0; f < 2; ++f) {
        const Vec3 p_WH = rest[f].p_WH + lift(t) * Vec3::UnitZ();
        sum[f] += kStep / kTicks * k * (runner.state.poseAt(0, t) * fingers[f].p_BP - p_WH);
      }
    }
    given.push_back({runner.state.finger_impulse_W[0], runner.state.finger_impulse_W[1]});
    felt.push_back(sum);
  }
  for (std::size_t n = 60; n + kWindow < given.size(); ++n) {
    for (std::size_t f = 0; f < 2; ++f) {
      const Vec3 on_body = given[n + kWindow][f] - given[n][f], on_finger = felt[n + kWindow][f] - felt[n][f];
      ASSERT_LT((on_body + on_finger).norm(), 0.01 * on_finger.norm()) << n << " finger " << f;
    }
  }
}

// A finger that left the surface since its sample must neither pull nor push before it is back.
TEST(Finger, GivesNoForceAcrossAGap) {
  for (const double speed : {0.0, -0.1, 0.1}) {
    Runner runner(WorldMaker().gravity(Vec3::Zero()).box(kCube, 0.1, {}).world());
    ReferenceFinger finger(0, {0, 0, kEdge / 2}, Vec3::UnitZ());
    finger.p_WH = finger.p_BP - 1e-6 * Vec3::UnitZ();
    ContactExchange exchange(1);
    exchange.fingers[0] = finger.contact({});
    exchange.fingers[0].p_WH = finger.p_BP + 0.001 * Vec3::UnitZ();  // 1 mm away; closes 0.5 mm at 0.1 m/s
    exchange.fingers[0].v_WH = -speed * Vec3::UnitZ();
    runner.step(exchange);
    EXPECT_EQ(runner.bodies.fingerForce(0), Vec3(Vec3::Zero())) << speed;
  }
}

// The mean of what the finger felt in the ticks since the step before: momentum follows the impulse to rounding.
TEST(AveragedCoupling, GivesTheImpulseThatWasFelt) {
  constexpr double kPushedMass = 0.5, kTick = 0.001;
  OdeOptions options;
  options.method.coupling = DynamicsSettings::Coupling::kAveraged;
  Runner runner(WorldMaker().gravity(Vec3::Zero()).box(kCube, kPushedMass, {Vec3::Zero(), Quat::Identity()}).world(),
                options);
  std::vector<ReferenceFinger> fingers{{0, {-kEdge / 2, 0, 0}, -Vec3::UnitX()}};
  fingers[0].p_WH = fingers[0].p_BP + 0.002 * Vec3::UnitX();
  Vec3 felt = Vec3::Zero();
  int steps = 0;
  for (; steps < 100; ++steps) {
    ContactExchange exchange = exchangeOf(fingers, runner);
    for (int tick = 0; tick < 5; ++tick) {
      const double time = runner.state.time_begin + (tick + 1) * kTick;
      const FingerContact contact = fingers[0].contact(runner.state.poseAt(0, time));
      if (contact.mode != ContactMode::kNone) felt += kTick * contact.f_H_W;
      fingers[0].p_WH += Vec3(0, 0, 1e-6);  // drags along the face
    }
    if (exchange.fingers[0].mode == ContactMode::kNone) break;
    exchange.fingers[0].impulse_H_W = felt;
    runner.step(exchange);
    ASSERT_LT((kPushedMass * runner[0].v_WB + felt).norm(), 1e-9) << steps;
  }
  EXPECT_GT(steps, 5);
  EXPECT_GT(felt.norm(), 0.01);
}

}  // namespace
}  // namespace presa::ode
