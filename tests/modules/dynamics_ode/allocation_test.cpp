#include "tests/modules/dynamics_ode/support.h"
#include "tests/support/alloc_lock_guard.h"

// A step neither allocates memory nor waits for a lock once a scene has gone through its motions; earlier allocations
// are kept.
namespace presa::ode {
namespace {

// Cubes in contact on all sides, or separate columns.
std::shared_ptr<const World> pile(int n, double apart = 0) {
  WorldMaker maker;
  maker.table();
  for (int i = 0; i < n * n * n; ++i) {
    const Vec3 cell(i % n, i / n % n, i / (n * n)), gap(apart, apart, -1e-6);
    maker.box(kCube, 0.1, {0.05 * cell + cell.cwiseProduct(gap) + Vec3(0, 0, 0.025 - 1e-6), Quat::Identity()});
  }
  return maker.world();
}

class Allocation : public testing::Test {
 protected:
  void SetUp() override {
    if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  }
  /// Steps for `duration` with these fingers and counts violations.
  static void expectNone(Runner& runner, double duration, std::vector<ReferenceFinger> fingers = {}) {
    for (const double end = runner.time + duration - kStep / 2; runner.time < end;) {
      const ContactExchange exchange = exchangeOf(fingers, runner);
      const RealTimeGuard guard;
      runner.step(exchange);
      ASSERT_EQ(guard.violations(), 0) << guard.first() << " at " << runner.time;
    }
  }
};

TEST_F(Allocation, NoneWhileACubeIsHeldAndPutDown) {
  Runner runner(WorldMaker().table().box(kCube, 0.1, {{0, 0, 0.025}, Quat::Identity()}).world(), awake());
  std::vector<ReferenceFinger> fingers = pinch(1, 0.05, 0.002, 2000, 0.8);
  for (ReferenceFinger& finger : fingers) finger.p_WH.z() += 0.03;
  for (int n = 0; n < 10; ++n) runner.step(exchangeOf(fingers, runner));
  expectNone(runner, 0.5, fingers);
  expectNone(runner, 0.5);
}

class PileAllocation : public Allocation, public testing::WithParamInterface<int> {};

TEST_P(PileAllocation, NoneWhileItIsAwake) {
  Runner runner(pile(GetParam()), awake());
  runner.run(0.1);
  expectNone(runner, 0.2);
}

TEST_P(PileAllocation, NoneWhileItFallsAsleepAndIsWoken) {
  Runner runner(pile(GetParam(), 0.001));
  runner.bodies.makeRoom(ContactExchange(1));
  runner.run(0.1);
  expectNone(runner, 1.9);
  ASSERT_TRUE(runner[1].asleep);
  std::vector<ReferenceFinger> fingers{{1, {-0.025, 0, 0}, -Vec3::UnitX()}};
  fingers[0].p_WH = runner[1].X_WB_end * fingers[0].p_BP + 0.002 * Vec3::UnitX();
  expectNone(runner, 0.1, fingers);
  EXPECT_FALSE(runner[1].asleep);
}
INSTANTIATE_TEST_SUITE_P(Of, PileAllocation, testing::Values(3, 5), [](const auto& param) {
  return std::to_string(param.param * param.param * param.param) + "Cubes";
});

}  // namespace
}  // namespace presa::ode
