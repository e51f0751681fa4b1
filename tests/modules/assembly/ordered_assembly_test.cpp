// Orders of a guide in a viewer, made by hand: what they may do to a body, and what not.
#include "modules/assembly/ordered_assembly.h"

#include <gtest/gtest.h>

#include "framework/core/graph/graph_builder.h"
#include "modules/assembly/goal_regions.h"
#include "tests/support/alloc_lock_guard.h"

namespace presa::assembly {
namespace {

using Status = GoalState::Status;

constexpr double kTick = 0.01;

class States final : public Module {
 public:
  States() : Module("states", RateGroup::kCollision) {
    objects.value.bodies.resize(3);
    orders.value.draws.resize(2);
  }
  void step(const Tick&) noexcept override {}
  Out<ObjectState> objects{*this, "object_state"};
  Out<GuideOrders> orders{*this, kGuideOrdersPort};
};

class Seen final : public Module {
 public:
  Seen() : Module("seen", RateGroup::kCollision) {}
  void step(const Tick&) noexcept override {}
  In<SnapConstraints> pulls{*this, "attractions"};
  In<AssemblyState> state{*this, "assembly_state"};
  In<TakenOrders> taken{*this, kTakenOrdersPort};
};

/// Two goals, one above the other, for two drums; reach 20 mm and 30 degrees. All bodies sleep, so that none is slowed.
class OrderedAssemblyTest : public testing::Test {
 protected:
  OrderedAssemblyTest() {
    auto world = std::make_shared<World>();
    world->scene.bodies.resize(3);
    Assembly assembly;
    assembly.goals = {{"lower", {0, 1}, {}, 1, {}}, {"upper", {0, 1}, {{0, 0, 0.1}, Quat::Identity()}, 1, {0}}};
    world->scene.assembly = assembly;
    world_ = world;
    GraphBuilder builder;
    states_ = &builder.add(std::make_unique<States>());
    builder.add(std::make_unique<OrderedAssembly>(world_));
    seen_ = &builder.add(std::make_unique<Seen>());
    builder.connectByName();
    graph_ = builder.build();
    graph_.start(RateGroup::kCollision);
    for (std::size_t i = 0; i < 3; ++i) {
      at(i, {1 + static_cast<double>(i), 0, 0});
      states_->objects.value.bodies[i].asleep = true;
    }
  }
  void at(std::size_t body, const Vec3& p) { states_->objects.value.bodies[body].X_WB_end.p = p; }
  void order(std::size_t goal, std::int32_t body) {
    GuideOrders::Draw& draw = states_->orders.value.draws[goal];
    draw = {body, draw.since + 1};
  }
  void step(int steps = 1) {
    for (int i = 0; i < steps; ++i) {
      graph_.step(RateGroup::kCollision,
                  {.index = index_, .time = kTick * static_cast<double>(index_), .period = kTick});
      ++index_;
    }
  }
  Status status(std::size_t goal) const { return seen_->state->goals[goal].status; }
  /// Acceleration with which the only pulled body is pulled [m/s^2]; 0: none is.
  double pull() const {
    const auto& bodies = seen_->pulls->bodies;
    return bodies.empty() ? 0 : bodies.front().max_acceleration;
  }

  std::shared_ptr<const World> world_;
  Graph graph_;
  States* states_ = nullptr;
  Seen* seen_ = nullptr;
  std::uint64_t index_ = 0;
};

TEST_F(OrderedAssemblyTest, PullsNothingByItself) {
  at(0, Vec3::Zero());
  step(50);
  EXPECT_EQ(pull(), 0);
  EXPECT_EQ(status(0), Status::kOpen);
}

// An order begins at zero force and rises as the pull of the run's own guide does, one step later.
TEST_F(OrderedAssemblyTest, RisesAsTheRunsOwnPull) {
  at(0, {0.015, 0, 0});
  GoalRegions own(*world_->scene.assembly, 3);
  order(0, 0);
  step();
  EXPECT_EQ(pull(), 0);
  for (int i = 0; i < 60; ++i) {
    step();
    own.step(states_->objects.value, kTick);
    ASSERT_EQ(pull(), own.snapConstraints().bodies.front().max_acceleration) << i;
    ASSERT_EQ(seen_->pulls->bodies.front().X_WB.p, own.snapConstraints().bodies.front().X_WB.p);
  }
}

// A forged order: for a body that is far away, for one out of its turn, for the same one twice, to and fro.
TEST_F(OrderedAssemblyTest, NoOrderMakesAJump) {
  order(0, 0);
  step(50);
  EXPECT_EQ(pull(), 0) << "1 m away";
  at(0, {0, 0, 0.1});
  order(1, 0);
  step(50);
  EXPECT_EQ(pull(), 0) << "the goal below is open";
  at(0, Vec3::Zero());
  at(1, {0.01, 0, 0});
  order(0, 0);
  order(1, 0);
  double last = 0;
  for (int i = 0; i < 400; ++i) {
    if (i % 7 == 0) order(0, i % 2);
    step();
    EXPECT_LE(pull() - last, 1.5 * 9.81 * kTick / GoalPulls::kRise + 1e-12) << i;
    EXPECT_LE(seen_->pulls->bodies.size(), 1u);
    last = pull();
  }
  EXPECT_LT(last, 1.5 * 9.81 * 8 * kTick / GoalPulls::kRise) << "a pull that is always new stays small";
}

// Without a further order, as from a guide that has died, the pull ends as the run's own one.
TEST_F(OrderedAssemblyTest, APullInProgressEndsWithoutTheGuide) {
  at(0, {0.01, 0, 0});
  order(0, 0);
  step(10);
  EXPECT_EQ(status(0), Status::kDrawing);
  at(0, Vec3::Zero());
  step(static_cast<int>(GoalPulls::kSettle / kTick) + 2);
  EXPECT_EQ(status(0), Status::kFilled);
  EXPECT_TRUE(seen_->pulls->bodies.front().fixed);

  at(1, {0.01, 0, 0.1});
  order(1, 1);
  step(10);
  EXPECT_EQ(status(1), Status::kDrawing);
  at(1, {0.03, 0, 0.1});  // torn out of the reach
  step();
  EXPECT_EQ(status(1), Status::kOpen);
  at(1, {0.01, 0, 0.1});
  step(50);
  EXPECT_EQ(status(1), Status::kOpen) << "only a new order pulls again";
  order(1, 1);
  step(2);
  EXPECT_EQ(status(1), Status::kDrawing);
}

TEST_F(OrderedAssemblyTest, AnUndoneBodyIsNotPulledBackByItsOldOrder) {
  at(0, Vec3::Zero());
  order(0, 0);
  step(30);
  ASSERT_EQ(status(0), Status::kFilled);
  ++states_->orders.value.undone;
  step(30);
  EXPECT_EQ(status(0), Status::kOpen);
  EXPECT_EQ(pull(), 0);
}

TEST_F(OrderedAssemblyTest, TellsWhatItTookAndAllocatesNothing) {
  at(0, Vec3::Zero());
  step();
  {
    const RealTimeGuard guard;
    order(0, 0);
    step(30);
    ++states_->orders.value.undone;
    order(1, 1);
    step();
    EXPECT_EQ(guard.violations(), 0) << guard.first();
  }
  OrderTaker taker;
  const TakenOrders::Order first = taker.next(seen_->taken.value()), second = taker.next(seen_->taken.value()),
                           third = taker.next(seen_->taken.value());
  EXPECT_EQ(first.tick, 1u);
  EXPECT_EQ(first.goal, 0);
  EXPECT_EQ(first.body, 0);
  EXPECT_EQ(second.goal, TakenOrders::kUndo);
  EXPECT_EQ(second.tick, 31u);
  EXPECT_EQ(third.goal, 1);
  EXPECT_EQ(taker.next(seen_->taken.value()).goal, TakenOrders::kNone);
}

}  // namespace
}  // namespace presa::assembly
