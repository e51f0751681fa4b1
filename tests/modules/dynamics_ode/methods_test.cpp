#include "modules/dynamics_ode/dynamics_module.h"
#include "tests/modules/dynamics_ode/support.h"

// Every alternative method that a scene can choose behaves as named, because studies compare them.
namespace presa::ode {
namespace {

OdeOptions with(const DynamicsSettings& method) {
  OdeOptions options;
  options.method = method;
  return options;
}

// Dzhanibekov's spin, 20 s (9 flips in a reference integration with steps of 10 us).
struct Tumble {
  int flips = 0;
  double energy_error = 0;
};
Tumble tumble(DynamicsSettings::Rotation rotation) {
  const Mat3 inertia = Vec3(1e-5, 2e-5, 2.5e-5).asDiagonal();
  const Vec3 spin(0.01, 20, 0.01);
  World world = *WorldMaker().gravity(Vec3::Zero()).add(Sphere{0.01}, {}, {0.1, Vec3::Zero(), inertia}).world();
  world.scene.bodies[0].w_WB = spin;
  DynamicsSettings method;
  method.rotation = rotation;
  Runner runner(std::make_shared<World>(world), with(method));
  Tumble result;
  double side = 1;
  for (int n = 0; n < 4000; ++n) {
    runner.step();
    const Vec3 w_B = runner[0].X_WB_end.q.conjugate() * runner[0].w_WB;
    if (w_B.y() * side < 0) ++result.flips, side = -side;
    const double energy = w_B.dot(inertia * w_B) / spin.dot(inertia * spin);
    result.energy_error = std::max(result.energy_error, std::abs(energy - 1));
  }
  return result;
}

// Flips and energy for ODE 0.16 as measured with an independent program (61, 0.114). Without the gyroscopic term the
// body never tumbles; one explicit Euler step gains energy.
TEST(Methods, RotationsTumbleAsTheyMust) {
  EXPECT_EQ(tumble(DynamicsSettings::Rotation::kExact).flips, 9);
  EXPECT_LT(tumble(DynamicsSettings::Rotation::kExact).energy_error, 1e-6);
  const Tumble engine = tumble(DynamicsSettings::Rotation::kEngine);
  EXPECT_EQ(engine.flips, 61);
  EXPECT_NEAR(engine.energy_error, 0.114, 0.001);
  EXPECT_GT(tumble(DynamicsSettings::Rotation::kEuler).energy_error, 0.1);
  // these keep the angular velocity in W constant while the body rotates: no precession, no energy balance
  for (const auto rotation : {DynamicsSettings::Rotation::kNone, DynamicsSettings::Rotation::kMatrix}) {
    EXPECT_EQ(tumble(rotation).flips, 0);
  }
}

// For rotation about a fixed axis the methods differ in a known way: angle per step w h (exact), 2 atan(w h / 2)
// (engine), atan(w h) (matrix), 2 atan(w h / 2) (normalised Euler step).
TEST(Methods, RotationsTurnByTheirOwnAnglePerStep) {
  const double angle = 0.3;
  const std::pair<DynamicsSettings::Rotation, double> expected[] = {
      {DynamicsSettings::Rotation::kExact, angle},
      {DynamicsSettings::Rotation::kEngine, 2 * std::atan(angle / 2)},
      {DynamicsSettings::Rotation::kNone, 2 * std::atan(angle / 2)},
      {DynamicsSettings::Rotation::kEuler, 2 * std::atan(angle / 2)},
      {DynamicsSettings::Rotation::kMatrix, std::atan(angle)}};
  for (const auto& [rotation, turned] : expected) {
    DynamicsSettings method;
    method.rotation = rotation;
    Runner runner(
        WorldMaker().gravity(Vec3::Zero()).add(Sphere{0.02}, {}, {0.1, Vec3::Zero(), 1e-5 * Mat3::Identity()}).world(),
        with(method));
    runner.bodies.setVelocity(0, Vec3::Zero(), {0, 0, angle / kStep});
    runner.step();
    const Quat q = runner[0].X_WB_end.q;
    EXPECT_NEAR(2 * std::atan2(q.z(), q.w()), turned, 1e-7) << static_cast<int>(rotation);
    EXPECT_NEAR(q.norm(), 1, 1e-12);
  }
}

// v = v0 + t F / m at every step with constant spin: closed form of semi-implicit Euler.
TEST(Methods, BodyStartsWithItsVelocityAndFeelsItsForce) {
  World world = *WorldMaker().box(kCube, 0.2, {{0.1, 0.2, 1}, Quat::Identity()}).world();
  Body& body = world.scene.bodies[0];
  body.v_WCm = {1, 2, 3};
  body.w_WB = {0, 0, 2};
  body.force_W = {0.4, 0, 0.2 * kGravity};
  Runner runner(std::make_shared<World>(world));
  EXPECT_EQ(runner[0].v_WB, body.v_WCm);
  runner.run(0.5);
  EXPECT_LT((runner[0].v_WB - Vec3(2, 2, 3)).norm(), 1e-12);
  EXPECT_LT((runner[0].w_WB - Vec3(0, 0, 2)).norm(), 1e-12);
}

// ODE's own pyramid holds a box along its diagonal where Coulomb friction (and Presa's) lets it slide: 31 degrees lies
// between atan 0.5 = 26.6 and atan(0.5 sqrt 2) = 35.3.
TEST(Methods, PyramidHoldsWhatTheConeLetsGo) {
  const double a = radians(31);
  for (const auto friction : {DynamicsSettings::Friction::kIsotropic, DynamicsSettings::Friction::kPyramid}) {
    WorldMaker maker;
    maker.gravity(kGravity * Vec3(std::sin(a) * std::sqrt(0.5), std::sin(a) * std::sqrt(0.5), -std::cos(a)));
    maker.table().box(kCube, 0.2, {{0, 0, 0.025}, Quat::Identity()});
    DynamicsSettings method;
    method.friction = friction;
    Runner runner(maker.world(), with(method));
    runner.run(0.5);
    const double slid = runner[1].X_WB_end.p.head<2>().norm();
    if (friction == DynamicsSettings::Friction::kPyramid) {
      EXPECT_LT(slid, 1e-3);
    } else {
      EXPECT_GT(slid, 0.05);
    }
  }
}

// A 1 g cube in a stiff grip distinguishes the solvers: exact when solved directly, far off with few iterations, closer
// with more iterations or smaller steps.
TEST(Methods, SolverIterationsAndSubstepsAreObeyed) {
  const double k = 10000, force = 20;
  const auto error = [&](const DynamicsSettings& method) {
    Runner runner(WorldMaker().gravity(Vec3::Zero()).box(kCube, 0.001, {{1e-4, 0, 0}, Quat::Identity()}).world(),
                  with(method));
    std::vector<ReferenceFinger> fingers = pinch(0, 0.05, 0.002, k, 1);
    for (int n = 0; n < 20; ++n) runner.step(exchangeOf(fingers, runner));
    return std::abs(runner.bodies.fingerForce(0).norm() - force);
  };
  DynamicsSettings direct, few, more, finer;
  direct.solver = DynamicsSettings::Solver::kDirect;
  few.solver = more.solver = finer.solver = DynamicsSettings::Solver::kIterative;
  few.iterations = finer.iterations = 4;
  more.iterations = 400;
  finer.substeps = 20;
  EXPECT_LT(error(direct), 1e-6);
  EXPECT_GT(error(few), 1);
  EXPECT_LT(error(more), 0.1);
  EXPECT_LT(error(finer), 0.1);
}

// The module takes all methods from the scene.
TEST(Methods, ModuleObeysTheScene) {
  const auto speed = [](DynamicsSettings::Rotation rotation) {
    World world = *WorldMaker()
                       .gravity(Vec3::Zero())
                       .add(Sphere{0.01}, {}, {0.1, Vec3::Zero(), Vec3(1e-5, 2e-5, 2.5e-5).asDiagonal()})
                       .world();
    world.scene.bodies[0].w_WB = {5, 5, 5};
    world.scene.dynamics.rotation = rotation;
    DynamicsModule module(std::make_shared<World>(world), 1);
    module.start();
    for (std::uint64_t n = 0; n < 20; ++n) module.step({n, static_cast<double>(n) * kStep, kStep});
    const Vec3 w_WB = static_cast<const Out<ObjectState>&>(*module.outputs().at(0)).value.bodies[0].w_WB;
    module.stop();
    return w_WB;
  };
  EXPECT_EQ(speed(DynamicsSettings::Rotation::kNone), Vec3(5, 5, 5));
  EXPECT_GT((speed(DynamicsSettings::Rotation::kExact) - Vec3(5, 5, 5)).norm(), 0.1);
}

}  // namespace
}  // namespace presa::ode
