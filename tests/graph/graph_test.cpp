#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "framework/graph/graph_builder.h"
#include "framework/schedule/executor.h"

namespace presa {
namespace {

struct Number {
  double value = 0;
};

/// Writes the number of its ticks.
class Counter final : public Module {
 public:
  Counter(std::string name, RateGroup group, std::string port)
      : Module(std::move(name), group), out(*this, std::move(port)) {}
  void step(const Tick&) noexcept override { out.value.value += 1; }
  Out<Number> out;
};

/// Adds one to what it reads, and remembers everything it saw.
class Follower final : public Module {
 public:
  Follower(std::string name, RateGroup group, std::string in_port, std::string out_port)
      : Module(std::move(name), group), in(*this, std::move(in_port)), out(*this, std::move(out_port)) {}
  void step(const Tick& tick) noexcept override {
    out.value.value = in.value().value + 1;
    seen.push_back(in.value().value);
    ages.push_back(in.age(tick));
  }
  In<Number> in;
  Out<Number> out;
  std::vector<double> seen, ages;
};

std::string findings(GraphBuilder& builder) {
  try {
    builder.build();
  } catch (const InputError& error) {
    return error.diagnostics().text();
  }
  return {};
}

// Modules of one rate see this tick's values, in whatever order they were added.
TEST(Graph, StepsWritersBeforeReadersWithinARate) {
  GraphBuilder builder;
  auto& last = builder.add(std::make_unique<Follower>("last", RateGroup::kHaptic, "b", "c"));
  auto& middle = builder.add(std::make_unique<Follower>("middle", RateGroup::kHaptic, "a", "b"));
  builder.add(std::make_unique<Counter>("first", RateGroup::kHaptic, "a"));
  builder.connectByName();
  Graph graph = builder.build();
  for (std::uint64_t i = 0; i < 5; ++i) graph.step(RateGroup::kHaptic, {i, 0, 0.001});
  EXPECT_EQ(middle.seen, (std::vector<double>{1, 2, 3, 4, 5}));
  EXPECT_EQ(last.seen, (std::vector<double>{2, 3, 4, 5, 6}));
}

// An input without a writer is named with its module, and the nearest port name is offered.
TEST(Graph, RejectsAnUnconnectedInputAndOffersTheNearestName) {
  GraphBuilder builder;
  builder.add(std::make_unique<Counter>("source", RateGroup::kHaptic, "object_state"));
  builder.add(std::make_unique<Follower>("reader", RateGroup::kHaptic, "object_stat", "x"));
  builder.connectByName();
  const std::string text = findings(builder);
  EXPECT_NE(text.find("reader.object_stat"), std::string::npos) << text;
  EXPECT_NE(text.find("did you mean 'object_state'"), std::string::npos) << text;
}

// A loop within a rate has no order: the whole way round is printed.
TEST(Graph, RejectsLoopAndPrintsIt) {
  GraphBuilder builder;
  builder.add(std::make_unique<Follower>("one", RateGroup::kHaptic, "b", "a"));
  builder.add(std::make_unique<Follower>("two", RateGroup::kHaptic, "a", "b"));
  builder.connectByName();
  const std::string text = findings(builder);
  EXPECT_NE(text.find("loop"), std::string::npos) << text;
  EXPECT_NE(text.find("one.a -> two.a"), std::string::npos) << text;
  EXPECT_NE(text.find("two.b -> one.b"), std::string::npos) << text;
}

// The same loop across rates is how a haptic system works: one side reads the value before.
TEST(Graph, AcceptsALoopAcrossRates) {
  GraphBuilder builder;
  builder.add(std::make_unique<Follower>("one", RateGroup::kHaptic, "b", "a"));
  builder.add(std::make_unique<Follower>("two", RateGroup::kDynamics, "a", "b"));
  builder.connectByName();
  EXPECT_EQ(builder.build().connections().size(), 2u);
}

struct Other {
  int value = 0;
};
class OtherReader final : public Module {
 public:
  OtherReader() : Module("other", RateGroup::kHaptic) {}
  void step(const Tick&) noexcept override {}
  In<Other> in{*this, "a"};
};

// Names agree but types do not; and everything that is wrong is said at once.
TEST(Graph, RejectsATypeMismatchAndADuplicateNameTogether) {
  GraphBuilder builder;
  builder.add(std::make_unique<Counter>("same", RateGroup::kHaptic, "a"));
  builder.add(std::make_unique<Counter>("same", RateGroup::kHaptic, "z"));
  builder.add(std::make_unique<OtherReader>());
  builder.connectByName();
  const std::string text = findings(builder);
  EXPECT_NE(text.find("different types"), std::string::npos) << text;
  EXPECT_NE(text.find("two modules are named 'same'"), std::string::npos) << text;
}

// Lockstep: at each instant dynamics, then collision, then haptic; a slow reader sees the newest value of the
// haptic tick before, one millisecond old.
TEST(Lockstep, MeetsRatesAtTheSameInstants) {
  GraphBuilder builder;
  auto& fast = builder.add(std::make_unique<Counter>("fast", RateGroup::kHaptic, "ticks"));
  auto& slow = builder.add(std::make_unique<Follower>("slow", RateGroup::kDynamics, "ticks", "unused"));
  builder.connectByName();
  Graph graph = builder.build();
  RunControl control;
  LockstepExecutor executor(graph, RateTable({.haptic = 1000, .collision = 100, .dynamics = 200, .view = 60}), control);
  executor.run(0.020);
  EXPECT_EQ(fast.out.value.value, 20);
  EXPECT_EQ(slow.seen, (std::vector<double>{0, 5, 10, 15}));
  for (std::size_t i = 1; i < slow.ages.size(); ++i) EXPECT_DOUBLE_EQ(slow.ages[i], 0.001);
  EXPECT_EQ(executor.timing(RateGroup::kHaptic).ticks, 20u);
  EXPECT_EQ(executor.timing(RateGroup::kDynamics).ticks, 4u);
}

// A replay that is told the versions reads exactly those, also when newer ones exist.
TEST(Replay, ReadsTheVersionsItIsTold) {
  GraphBuilder builder;
  builder.add(std::make_unique<Counter>("fast", RateGroup::kHaptic, "ticks"));
  auto& slow = builder.add(std::make_unique<Follower>("slow", RateGroup::kDynamics, "ticks", "unused"));
  builder.connectByName();
  Graph graph = builder.build();
  graph.keepHistory(1 << 16);
  for (std::uint64_t i = 0; i < 10; ++i) ASSERT_TRUE(graph.replayStep(RateGroup::kHaptic, {i, 0, 0.001}, {}));
  ScheduleRow row;
  for (const std::uint64_t version : {0, 3, 7, 10}) {
    row.versions[0] = version;
    EXPECT_TRUE(graph.replayStep(RateGroup::kDynamics, {0, 0, 0.005}, row));
  }
  row.versions[0] = 11;
  EXPECT_FALSE(graph.replayStep(RateGroup::kDynamics, {0, 0, 0.005}, row));
  EXPECT_EQ(slow.seen, (std::vector<double>{0, 3, 7, 10}));
}

// Real threads: every group does its ticks, no value is lost for good, and a stop request ends all of them.
TEST(Realtime, RunsEveryGroupAndStopsOnRequest) {
  GraphBuilder builder;
  auto& fast = builder.add(std::make_unique<Counter>("fast", RateGroup::kHaptic, "ticks"));
  auto& slow = builder.add(std::make_unique<Follower>("slow", RateGroup::kDynamics, "ticks", "unused"));
  builder.connectByName();
  Graph graph = builder.build();
  RunControl control;
  control.stop_requested = true;  // from the start: the run is exactly one tick and the fade long
  RealtimeExecutor executor(graph, RateTable(Rates{}), control);
  executor.run(10);
  const auto expected = 1 + static_cast<std::uint64_t>(Executor::kFadeTime * 1000);
  EXPECT_EQ(executor.timing(RateGroup::kHaptic).ticks + executor.timing(RateGroup::kHaptic).skipped, expected);
  EXPECT_EQ(fast.out.value.value, static_cast<double>(executor.timing(RateGroup::kHaptic).ticks));
  EXPECT_GT(slow.seen.back(), 0);
  for (std::size_t i = 1; i < slow.seen.size(); ++i) EXPECT_GE(slow.seen[i], slow.seen[i - 1]);
}

}  // namespace
}  // namespace presa
