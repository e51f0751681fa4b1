#include <cstring>
#include <limits>

#include "framework/core/graph/graph_builder.h"
#include "modules/dynamics_ode/dynamics_module.h"
#include "tests/modules/dynamics_ode/support.h"
#include "tests/support/effort.h"

namespace presa::ode {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// n x n x n cubes dropped on a table with small gaps and rotations.
std::shared_ptr<const World> heap(int n) {
  WorldMaker maker;
  maker.table();
  for (int i = 0; i < n * n * n; ++i) {
    const Vec3 cell(i % n, i / n % n, i / (n * n));
    maker.box(kCube, 0.1, {0.052 * cell + Vec3(0, 0, 0.026), turn(0.1 * i, {0.1, 0.2 * (i % 3), 1})});
  }
  return maker.world();
}

bool sameBits(const ObjectState& a, const ObjectState& b) {
  bool same = a.count() == b.count() && a.time_end == b.time_end;
  for (std::size_t i = 0; same && i < a.bodies.size(); ++i) {
    same = a.bodies[i].X_WB_end.p == b.bodies[i].X_WB_end.p &&
           a.bodies[i].X_WB_end.q.coeffs() == b.bodies[i].X_WB_end.q.coeffs() && a.bodies[i].v_WB == b.bodies[i].v_WB &&
           a.bodies[i].w_WB == b.bodies[i].w_WB;
  }
  return same;
}

// Recordings are replayed to the bit: two worlds of the same scene, stepped in turn (which would mix ODE's global
// random numbers) and with allocations in between, must agree in every bit, whatever solves them.
TEST(Determinism, SameCallsGiveTheSameBits) {
  using Solver = DynamicsSettings::Solver;
  for (const Solver solver :
       {Solver::kAuto, Solver::kDirect, Solver::kIterative, Solver::kNewton, Solver::kSmallSteps}) {
    OdeOptions options;
    options.method.solver = solver;
    const auto world = heap(3);
    Runner a(world, options);
    const std::vector<std::unique_ptr<int>> elsewhere(1000);
    Runner b(world, options);
    std::vector<ReferenceFinger> fingers = pinch(14, 0.05, 0.002, 2000, 0.8);
    for (ReferenceFinger& finger : fingers) finger.p_WH += a[14].X_WB_end.p;
    for (int n = 0; n < unlessSanitized(200, 10); ++n) {
      const ContactExchange exchange = exchangeOf(fingers, a);
      a.step(exchange);
      b.step(exchange);
      ASSERT_TRUE(sameBits(a.state, b.state)) << n;
    }
    EXPECT_FALSE(a.bodies.contacts().empty());
  }
}

// Small steps are used only for the heap: a light cube held elsewhere keeps Newton's exact grip.
TEST(Islands, HeldCubeIsSolvedExactlyBesideALargeHeap) {
  WorldMaker maker;
  maker.table();
  for (int i = 0; i < 27; ++i)
    maker.box(kCube, 0.1, {{0.05 * (i % 3), 0.05 * (i / 3 % 3), 0.025 + 0.05 * (i / 9)}, Quat::Identity()});
  maker.box(kCube, 0.001, {{0, 0.8, 0.5}, Quat::Identity()});
  OdeOptions options = awake();
  options.newton_work = 5;
  options.small_steps.count = 1;
  Runner runner(maker.world(), options);
  std::vector<ReferenceFinger> fingers = pinch(28, 0.05, 0.002, 10000, 1);
  for (ReferenceFinger& finger : fingers) {
    finger.damping = 0.5;
    finger.p_WH += runner[28].X_WB_end.p;
  }
  for (int n = 0; n < 400; ++n) runner.step(exchangeOf(fingers, runner));
  EXPECT_GT(runner.bodies.contacts().size(), 20U);
  for (std::size_t f = 0; f < 2; ++f) EXPECT_NEAR(runner.bodies.fingerForce(f).norm(), 20, 0.02);
}

// Invalid data from another thread are ignored and counted, and the bodies go on.
TEST(Faults, BadFingerContactIsIgnoredAndCounted) {
  Runner runner(WorldMaker().gravity(Vec3::Zero()).box(kCube, 0.1, {}).table().world());
  std::vector<ReferenceFinger> fingers = pinch(0, 0.05, 0.002, 1000, 1);
  const ContactExchange good = exchangeOf(fingers, runner);
  std::vector<ContactExchange> bad(4, good);
  for (ContactExchange& exchange : bad) exchange.fingers[1].mode = ContactMode::kNone;
  bad[0].fingers[0].p_WH.x() = kNan;
  bad[1].fingers[0].stiffness = std::numeric_limits<double>::infinity();
  bad[2].fingers[0].body = 7;
  bad[3].fingers[0].nhat_B.setZero();
  for (std::size_t i = 0; i < bad.size(); ++i) {
    runner.step(bad[i]);
    EXPECT_EQ(runner.bodies.faults().count, i + 1);
    EXPECT_EQ(runner.bodies.fingerForce(0), Vec3(Vec3::Zero()));
    EXPECT_EQ(runner.bodies.faults().bits, Faults::kBadFinger);
  }
  // a contact with a fixed body is valid and has no effect
  ContactExchange table = good;
  table.fingers[0].body = table.fingers[1].body = 1;
  runner.step(table);
  EXPECT_EQ(runner.bodies.faults().count, bad.size());
  EXPECT_TRUE(runner[0].X_WB_end.p.allFinite());
}

// A sample without a velocity spoils neither its own step nor the acceleration of the next.
TEST(Faults, VelocityThatIsNoNumberIsForgotten) {
  Runner runner(WorldMaker().gravity(Vec3::Zero()).box(kCube, 0.1, {}).world());
  std::vector<ReferenceFinger> fingers = pinch(0, 0.05, 0.002, 1000, 1);
  for (int n = 0; n < 4; ++n) {
    ContactExchange exchange = exchangeOf(fingers, runner);
    if (n == 1) exchange.fingers[0].v_WH.x() = kNan;
    runner.step(exchange);
    EXPECT_EQ(runner.bodies.faults().bits, n == 0 ? 0U : Faults::kBadFinger);
    EXPECT_TRUE(runner.bodies.fingerForce(0).allFinite()) << n;
  }
}

// A runaway finger (1 m inside at 1e9 N/m) throws a body out of all bounds: it freezes at its last good pose, as an
// obstacle on which the others still rest.
TEST(Faults, RunawayBodyFreezesAtItsLastGoodPose) {
  WorldMaker maker;
  maker.table().box(kCube, 0.1, {{0, 0, 0.025}, Quat::Identity()}).box(kCube, 0.1, {{0, 0, 0.075}, Quat::Identity()});
  Runner runner(maker.world());
  runner.run(1);
  const Pose good = runner[1].X_WB_end;
  ReferenceFinger finger(1, {0.025, 0, 0}, {1, 0, 0});
  finger.stiffness = 1e9;
  finger.p_WH = Vec3(-1e3, 0, 0.025);
  std::vector<ReferenceFinger> fingers{finger};
  runner.step(exchangeOf(fingers, runner));
  EXPECT_NE(runner.bodies.faults().bits & Faults::kBodyFrozen, 0U);
  EXPECT_LT((runner[1].X_WB_end.p - good.p).norm(), 1e-12);
  EXPECT_EQ(runner[1].v_WB, Vec3(Vec3::Zero()));
  runner.run(1);
  EXPECT_LT((runner[1].X_WB_end.p - good.p).norm(), 1e-12);
  EXPECT_NEAR(runner[2].X_WB_end.p.z(), 0.075, 1e-3);
}

// A failed assertion inside ODE (here: a step of duration 0) would end the process. Instead it freezes the bodies and
// is reported, permanently; another world is not affected.
TEST(Faults, FailureInsideTheEngineFreezesThatWorldOnly) {
  const auto world = WorldMaker().box(kCube, 0.1, {{0, 0, 1}, Quat::Identity()}).world();
  OdeOptions options;
  options.method.solver = DynamicsSettings::Solver::kDirect;
  Runner broken(world, options), other(world, options);
  broken.step();
  const Vec3 p = broken[0].X_WB_end.p;
  broken.step({}, 0);
  EXPECT_EQ(broken.bodies.faults().bits, Faults::kEngineFailed);
  broken.step();
  EXPECT_EQ(broken[0].X_WB_end.p, p);
  EXPECT_EQ(broken[0].v_WB, Vec3(Vec3::Zero()));
  other.run(0.1);
  EXPECT_LT(other[0].X_WB_end.p.z(), 0.99);
  EXPECT_EQ(other.bodies.faults().count, 0U);
}

// Contacts so redundant and squeezed that ODE's direct solver fails are restored and solved iteratively: the state
// stays finite and bounded, and the step is counted. Presa's own solvers need no way out.
class SqueezedUnderALid : public testing::TestWithParam<DynamicsSettings::Solver> {};

TEST_P(SqueezedUnderALid, StaysFiniteAndInPlace) {
  WorldMaker maker;
  maker.table().fixedBox({2, 2, 0.1}, {{0, 0, 0.145}, Quat::Identity()});  // a lid 5 mm into everything below
  for (int i = 0; i < 12; ++i) {
    maker.box({0.1, 0.1, 0.1}, i % 2 == 0 ? 1e-4 : 1e3, {{0.095 * (i % 4), 0.095 * (i / 4), 0.05}, Quat::Identity()});
  }
  OdeOptions options;
  options.method.solver = GetParam();
  options.contact_softness = 1e-9;
  Runner runner(maker.world(), options);
  for (int n = 0; n < 100; ++n) runner.step();
  RecordProperty("fallback_steps", static_cast<int>(runner.bodies.fallbackSteps()));
  EXPECT_EQ(runner.bodies.fallbackSteps() > 0, GetParam() == DynamicsSettings::Solver::kDirect);
  EXPECT_EQ(runner.bodies.faults().count, 0U);
  for (std::size_t i = 2; i < 14; ++i) EXPECT_LT(runner[i].X_WB_end.p.norm(), 1);
}
INSTANTIATE_TEST_SUITE_P(SolvedBy, SqueezedUnderALid,
                         testing::Values(DynamicsSettings::Solver::kDirect, DynamicsSettings::Solver::kNewton,
                                         DynamicsSettings::Solver::kSmallSteps));

// The module is the same world behind ports, started and stopped on an executor's thread.
TEST(Module, PublishesTheStateOfItsWorld) {
  const auto world = WorldMaker().table().box(kCube, 0.1, {{0, 0, 0.3}, Quat::Identity()}).world();
  GraphBuilder builder;
  auto& module = builder.add(std::make_unique<DynamicsModule>(world, 1));
  const Graph graph = builder.build();
  const auto& out = static_cast<const Out<ObjectState>&>(*module.outputs().at(0));
  module.start();
  EXPECT_EQ(out.value.count(), 2);
  Runner runner(world);
  for (std::uint64_t n = 0; n < 50; ++n) {
    module.step({n, static_cast<double>(n) * kStep, kStep});
    runner.time = static_cast<double>(n) * kStep;
    runner.step();
    ASSERT_TRUE(sameBits(out.value, runner.state)) << n;
  }
  EXPECT_EQ(module.faults().count, 0U);
  EXPECT_EQ(module.group(), RateGroup::kDynamics);
  EXPECT_EQ(module.inputs().at(0)->name(), "contact_exchange");
  EXPECT_EQ(module.outputs().at(0)->name(), "object_state");
  module.stop();
}

}  // namespace
}  // namespace presa::ode
