#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "framework/haptics/body_effects.h"
#include "modules/dynamics_ode/ode_world.h"
#include "tests/support/alloc_lock_guard.h"
#include "tests/support/body_effect_field.h"

namespace presa {
namespace {

constexpr double kStep = 0.005, kGravity = 9.81, kMass = 0.1;

using Values = std::map<std::string, std::string>;

/// A free box of 0.1 kg far from everything, with a drag.
World falling(const Values& drag) {
  World world;
  Body body;
  body.name = "box";
  body.physics = Geometry{Box{{0.05, 0.06, 0.07}}, {}, {}};
  world.scene.bodies = {body};
  world.scene.materials.resize(1);
  world.scene.devices.resize(1);
  world.scene.gravity = Vec3(0, 0, -kGravity);
  Values values{{"max_force", "10"}, {"linear", "0"},     {"quadratic", "0"},
                {"turning", "0"},    {"max_torque", "1"}, {"flow", "0 0 0"}};
  for (const auto& [name, value] : drag) values[name] = value;
  world.scene.plugin_elements = {{"drag", "drag", 0, values, {}, PluginKind::kBodyEffect}};
  world.meshes.resize(1);
  world.inertias = {{kMass, Vec3::Zero(), Vec3(0.085, 0.074, 0.061).asDiagonal().toDenseMatrix() * (1e-3 / 1.2)}};
  return world;
}

struct Fall {
  explicit Fall(World made) : world(std::make_shared<World>(std::move(made))), effects(*world), bodies(world) {
    bodies.use(effects);
    objects.bodies.resize(1);
    bodies.write(0, objects);
  }
  const BodyMotion& step() {
    bodies.step({}, kStep * count, kStep, objects);
    ++count;
    return objects.bodies[0];
  }
  int count = 0;
  std::shared_ptr<const World> world;
  BodyEffects effects;
  ode::OdeWorld bodies;
  ObjectState objects;
};

TEST(Drag, IsLinearPlusQuadraticUpToItsBound) {
  test::BodyEffectField field(R"(<drag max_force="2" linear="0.5" quadratic="0.25" turning="0.1" flow="1 0 0"/>)");
  // u = (0, 3, 4): |u| = 5, full = 0.5 + 1.25 = 1.75, |f| = 8.75 N, above its bound
  EXPECT_TRUE(field.at({.v_WCm = Vec3(1, 3, 4)}).f_W.isApprox(Vec3(0, -1.2, -1.6)));
  // u = (1, 0, 0): f = -0.75 N, slope 0.5 + 2 * 0.25
  const BodyEffectWrench slow = field.at({.v_WCm = Vec3(2, 0, 0), .w_WB = Vec3(0, 0, 2)});
  EXPECT_TRUE(slow.f_W.isApprox(Vec3(-0.75, 0, 0)));
  EXPECT_DOUBLE_EQ(slow.rates.damping, 1);
  EXPECT_TRUE(slow.torque_W.isApprox(Vec3(0, 0, -0.2)));
  EXPECT_EQ(field.at({.v_WCm = Vec3(1, 0, 0)}).f_W, Vec3::Zero());
}

TEST(Drag, NeitherAllocatesNorLocks) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  test::BodyEffectField field(R"(<drag max_force="2" quadratic="0.25"/>)");
  const RealTimeGuard guard;
  for (int i = 0; i < 100; ++i) field.at({.v_WCm = Vec3(0.1 * i, 0, 0)});
  EXPECT_EQ(guard.violations(), 0) << guard.first();
}

// Closed form: v = v_t tanh(g t / v_t), v_t = sqrt(m g / c). A step errs by h^2 / 2 |a df/dv| / m, and a later step only shrinks an
// error, so that all of them sum up to at most h / 2 times the integral of 2 c v / m dv from 0 to v_t, which is h g / 2.
TEST(Drag, FallsAsTheClosedFormSays) {
  constexpr double kQuadratic = 0.25;
  Fall fall(falling({{"quadratic", "0.25"}}));
  const double v_t = std::sqrt(kMass * kGravity / kQuadratic);
  double worst = 0, v = 0;
  for (int i = 1; i <= 400; ++i) {
    v = -fall.step().v_WB.z();
    worst = std::max(worst, std::abs(v - v_t * std::tanh(kGravity * kStep * i / v_t)));
  }
  EXPECT_LT(worst, kStep * kGravity / 2);
  // tanh approaches v_t with the rate 2 g / v_t, the step with 1 / (1 + 2 g h / v_t); the factor is twice that of tanh
  EXPECT_NEAR(v, v_t, 4 * v_t * std::pow(1 + 2 * kGravity * kStep / v_t, -400) + 1e-12);
}

// v = v_t (1 - exp(-b t / m)). Linearly implicit Euler is exact for v_t; a step errs by h^2 / 2 g b / m exp(-b t / m), sum h g / 2.
TEST(Drag, FallsInAThickMediumAsTheClosedFormSays) {
  Fall fall(falling({{"linear", "0.5"}}));
  const double v_t = kMass * kGravity / 0.5;
  for (int i = 1; i <= 400; ++i) {
    const double v = -fall.step().v_WB.z();
    EXPECT_NEAR(v, v_t * (1 - std::exp(-0.5 / kMass * kStep * i)), kStep * kGravity / 2) << i;
  }
}

// An explicit step would be unstable above 2 m / h = 40 N s/m. The speed goes to its limit from one side and never past it.
TEST(Drag, IsStableWithAnyCoefficient) {
  for (const char* linear : {"30", "50", "1000", "1e6", "1e12"}) {
    Fall fall(falling({{"linear", linear}, {"max_force", "1e13"}}));
    const double v_t = kMass * kGravity / std::stod(linear);
    fall.bodies.setVelocity(0, Vec3(1, 0, 0), Vec3::Zero());
    double last = 1;
    for (int i = 0; i < 100; ++i) {
      const Vec3 v = fall.step().v_WB;
      EXPECT_LE(v.x(), last) << linear;
      EXPECT_GE(v.x(), 0) << linear;
      last = v.x();
    }
    EXPECT_NEAR(-fall.objects.bodies[0].v_WB.z(), v_t, 1e-9 * v_t) << linear;
    EXPECT_EQ(fall.bodies.faults().bits, 0u) << linear;
  }
}

// With its bound far below what the coefficient asks for, the drag is a constant force: v falls by F h / m per step, or more
// slowly because the slope across is in the step; it never turns round.
TEST(Drag, DoesNotTurnTheBodyRoundAtItsBound) {
  Fall fall([] {
    World world = falling({{"linear", "1e6"}, {"max_force", "5"}});
    world.scene.gravity.setZero();
    return world;
  }());
  fall.bodies.setVelocity(0, Vec3(1.1, 0, 0), Vec3::Zero());
  double last = 1.1;
  for (int i = 0; i < 200; ++i) {
    const double v = fall.step().v_WB.x();
    EXPECT_GE(v, 0);
    EXPECT_LE(last - v, 5 * kStep / kMass * (1 + 1e-12));
    last = v;
  }
  EXPECT_LT(last, 1e-9);
}

// w = w_0 (1 + h b / I)^-n about a principal axis: backward Euler, exact to rounding.
TEST(Drag, SlowsTheRotation) {
  Fall fall(falling({{"turning", "0.001"}}));
  fall.bodies.setVelocity(0, Vec3::Zero(), Vec3(0, 0, 3));
  const double moment = fall.world->inertias[0].inertia(2, 2);
  for (int i = 1; i <= 50; ++i) {
    const double expected = 3 * std::pow(1 + kStep * 0.001 / moment, -i);
    EXPECT_NEAR(fall.step().w_WB.z(), expected, 1e-12) << i;
  }
}

// A body that floats in a flow drifts with it.
TEST(Drag, CarriesTheBodyWithTheFlow) {
  Fall fall(falling({{"linear", "1000"}, {"flow", "0.3 0 0"}}));
  for (int i = 0; i < 50; ++i) fall.step();
  EXPECT_NEAR(fall.objects.bodies[0].v_WB.x(), 0.3, 1e-12);
}

// A box at rest without gravity sleeps within 2 s. It wakes in the step in which a push sets in.
TEST(BodyEffects, WakeASleepingBodyWhenTheirWrenchChanges) {
  ASSERT_EQ(::setenv("PRESA_PLUGIN_PATH", PRESA_BINARY_DIR "/tests/plugins", 1), 0);
  Fall fall([] {
    World world = falling({});
    world.scene.gravity.setZero();
    world.scene.plugin_elements = {{"faulty_body",
                                    "faulty_body",
                                    kNoBody,
                                    {{"max_force", "1"}, {"fault", "push"}, {"after", "3"}},
                                    {},
                                    PluginKind::kBodyEffect}};
    return world;
  }());
  for (int i = 0; i < 600; ++i) fall.step();
  EXPECT_TRUE(fall.objects.bodies[0].asleep);
  for (int i = 0; i < 20; ++i) fall.step();
  EXPECT_FALSE(fall.objects.bodies[0].asleep);
  EXPECT_NEAR(fall.objects.bodies[0].v_WB.x(), 0.5 / kMass * 20 * kStep, 0.5 / kMass * kStep);  // within a step
}

TEST(Drag, StepsWithoutAllocation) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  Fall fall(falling({{"linear", "1"}}));
  for (int i = 0; i < 10; ++i) fall.step();
  const RealTimeGuard guard;
  for (int i = 0; i < 10; ++i) fall.step();
  EXPECT_EQ(guard.violations(), 0) << guard.first();
}

}  // namespace
}  // namespace presa
