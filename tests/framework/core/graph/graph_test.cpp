#include <gtest/gtest.h>

#include <memory>
#include <tuple>
#include <vector>

#include "framework/core/graph/graph_builder.h"
#include "framework/core/schedule/catch_up.h"
#include "framework/core/schedule/executor.h"

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

/// Adds one to its input, and keeps all inputs.
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

// Modules of one rate read this tick's values, independently of the order in which they were added.
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

// A loop within a rate group has no step order: the error prints the whole loop.
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

// The same loop across rates is allowed, and usual in a haptic system: one side reads the previous value.
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

// Ports of the same name but different types are refused; all errors are reported at once.
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

/// Keeps the ticks of its steps.
class Diary final : public Module {
 public:
  Diary() : Module("diary", RateGroup::kHaptic) {}
  void step(const Tick& tick) noexcept override { ticks.push_back(tick); }
  std::vector<Tick> ticks;
};

// After a stall of 50 ms in virtual time the delayed ticks run at once, and only the newest writes to the device. After
// a longer stall, all but the newest tick are skipped and counted.
TEST(Lockstep, MarksTheTicksThatAStallMadeUp) {
  for (const auto& [stall, catch_up, skipped] : {std::tuple{0.050, 50u, 0u}, std::tuple{0.200, 0u, 200u}}) {
    GraphBuilder builder;
    auto& diary = builder.add(std::make_unique<Diary>());
    Graph graph = builder.build();
    RunControl control;
    LockstepExecutor executor(graph, RateTable(Rates{}), control);
    executor.delay([end = 0.100 + stall](RateGroup, double time) { return time >= 0.100 && time < end - 1e-9; });
    executor.run(0.400);
    EXPECT_EQ(diary.ticks.size(), 400u - skipped);
    unsigned marked = 0;
    for (const Tick& tick : diary.ticks) {
      marked += tick.catch_up ? 1 : 0;
      EXPECT_EQ(tick.catch_up, catch_up > 0 && tick.time > 0.0995 && tick.time < 0.1495) << tick.time;
    }
    EXPECT_EQ(marked, catch_up);
    EXPECT_EQ(executor.timing(RateGroup::kHaptic).skipped, skipped);
  }
}

// Times at which ticks write to a device: ticks take `cost_us`, and the loop was stalled for `stall_us` at the start.
std::vector<std::int64_t> sentAt(std::int64_t stall_us, std::int64_t cost_us, int ticks) {
  CatchUp catch_up(1000);
  std::vector<std::int64_t> sent;
  std::int64_t now = stall_us;
  for (int i = 0; i < ticks; ++i) {
    now = std::max<std::int64_t>(now, 1000 * i);
    if (!catch_up.isCatchUp(now, now - 1000 * i)) sent.push_back(now);
    now += cost_us;
  }
  return sent;
}

TEST(CatchUp, SendsOnlyTheNewestOfWhatWasMissed) {
  EXPECT_EQ(sentAt(0, 20, 4), (std::vector<std::int64_t>{0, 1000, 2000, 3000}));
  EXPECT_EQ(sentAt(900, 20, 3), (std::vector<std::int64_t>{900, 1000, 2000}));  // late, but nothing was missed
  // 10.5 ms late: the eleventh tick is the newest that is due
  EXPECT_EQ(sentAt(10'500, 20, 13), (std::vector<std::int64_t>{10'700, 11'000, 12'000}));
}

// Ticks that take longer than a period never catch up; the device still gets a force once per period.
TEST(CatchUp, StillSendsOnceAPeriodWhenItNeverCatchesUp) {
  const std::vector<std::int64_t> sent = sentAt(0, 1500, 100);
  ASSERT_GT(sent.size(), 90u);
  for (std::size_t i = 1; i < sent.size(); ++i) EXPECT_LE(sent[i] - sent[i - 1], 3000);
  const std::vector<std::int64_t> slow = sentAt(50'000, 700, 100);  // 167 ticks to catch up
  for (std::size_t i = 1; i < slow.size(); ++i) {
    EXPECT_GE(slow[i] - slow[i - 1], 1000);
    EXPECT_LE(slow[i] - slow[i - 1], 1400);
  }
}

// A recording holds the names of the values read across rates.
TEST(Graph, RejectsTwoValuesOfOneNameAcrossRates) {
  const auto found = [](RateGroup readers) {
    GraphBuilder builder;
    auto& one = builder.add(std::make_unique<Counter>("one", RateGroup::kHaptic, "ticks"));
    auto& two = builder.add(std::make_unique<Counter>("two", RateGroup::kHaptic, "ticks"));
    auto& first = builder.add(std::make_unique<Follower>("first", readers, "ticks", "x"));
    auto& second = builder.add(std::make_unique<Follower>("second", readers, "ticks", "y"));
    builder.connect(one.out, first.in);
    builder.connect(two.out, second.in);
    return findings(builder);
  };
  EXPECT_NE(found(RateGroup::kDynamics).find("error[E508]: the dynamics group reads two values named 'ticks'"),
            std::string::npos)
      << found(RateGroup::kDynamics);
  EXPECT_EQ(found(RateGroup::kHaptic), "");  // in place
  EXPECT_EQ(found(RateGroup::kBus), "");     // never recorded
}

// A replay reads exactly the recorded versions, even if newer ones exist.
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

// Real threads: every group runs its ticks, the newest value always arrives, and a stop request ends all groups.
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
