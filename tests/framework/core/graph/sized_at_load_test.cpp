// SizedAtLoad values: memory is allocated when the graph is built, and never again.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "framework/assembly/assembly_state.h"
#include "framework/assembly/snap_constraint.h"
#include "framework/core/graph/graph_builder.h"
#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/device_state.h"
#include "framework/core/state/finger_neighbourhood.h"
#include "framework/core/state/object_state.h"
#include "tests/support/alloc_lock_guard.h"

namespace presa {
namespace {

static_assert(SizedAtLoad<ObjectState> && SizedAtLoad<SnapConstraints> && SizedAtLoad<AssemblyState> &&
              SizedAtLoad<FingerNeighbourhoods> && SizedAtLoad<ContactExchange> && SizedAtLoad<DeviceState> &&
              SizedAtLoad<ForceCommand>);
static_assert(!ExchangedData<std::vector<int>>, "what says nothing of its room may take some at any time");

constexpr std::size_t kBodies = 5000;

/// Bodies whose position is the number of steps.
class Bodies final : public Module {
 public:
  Bodies() : Module("bodies", RateGroup::kDynamics) { out.value.bodies.resize(kBodies); }
  void step(const Tick& tick) noexcept override {
    for (BodyMotion& body : out.value.bodies) body.X_WB_end.p.x() = static_cast<double>(tick.index + 1);
  }
  Out<ObjectState> out{*this, "object_state"};
};

class Reader final : public Module {
 public:
  Reader() : Module("reader", RateGroup::kHaptic) {}
  void step(const Tick&) noexcept override {
    count = in->count();
    way = count > 0 ? in->bodies.back().X_WB_end.p.x() : 0;
  }
  In<ObjectState> in{*this, "object_state"};
  std::int32_t count = -1;
  double way = -1;
};

struct Pair {
  Pair() {
    GraphBuilder builder;
    builder.add(std::make_unique<Bodies>());
    reader = &builder.add(std::make_unique<Reader>());
    builder.connectByName();
    graph = builder.build();
  }
  Graph graph;
  Reader* reader = nullptr;
};

TEST(SizedAtLoad, TakesNoMemoryFromTheFirstPublicationOn) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  Pair pair;
  const RealTimeGuard guard;
  // seven steps and seven reads: each of the three slots is written and read more than once
  for (std::uint64_t n = 0; n < 7; ++n) {
    pair.graph.step(RateGroup::kDynamics, {n, 0, 0.005});
    pair.graph.step(RateGroup::kHaptic, {n, 0, 0.001});
    EXPECT_EQ(pair.reader->way, static_cast<double>(n + 1));
  }
  EXPECT_EQ(guard.violations(), 0) << guard.first();
  EXPECT_EQ(pair.reader->count, static_cast<std::int32_t>(kBodies));
}

// A value that copies by its own rules takes memory for all fingers at once, although only the first is in use.
TEST(SizedAtLoad, NeighbourhoodsOfMoreFingersInUseTakeNoMemory) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  FingerNeighbourhoods source;
  source.fingers.resize(20);
  source.count = 1;
  LatestValue<FingerNeighbourhoods> latest(source);
  const RealTimeGuard guard;
  for (std::int32_t count = 1; count <= 20; ++count) {
    source.count = count;
    source.fingers[static_cast<std::size_t>(count - 1)].serial = 1;
    latest.publish(source, 0);
    ASSERT_TRUE(latest.update());
    EXPECT_EQ(latest.value().fingers[static_cast<std::size_t>(count - 1)].serial, 1u);
  }
  EXPECT_EQ(guard.violations(), 0) << guard.first();
  EXPECT_GE(source.roomBytes(), 20 * kMaxNearBodies * sizeof(NearBody));
}

// Before the first step a reader finds no bodies, although memory is already allocated.
TEST(SizedAtLoad, HasNoBodiesBeforeTheFirstPublication) {
  Pair pair;
  pair.graph.step(RateGroup::kHaptic, {0, 0, 0.001});
  EXPECT_EQ(pair.reader->count, 0);
  EXPECT_FALSE(pair.reader->in.hasValue());
}

TEST(SizedAtLoad, AReplayReadsTheVersionsItIsToldAndTakesNoMemoryOnTheWay) {
  Pair pair;
  pair.graph.keepHistory(0);
  const RealTimeGuard guard;
  for (std::uint64_t n = 0; n < 100; ++n) ASSERT_TRUE(pair.graph.replayStep(RateGroup::kDynamics, {n, 0, 0.005}, {}));
  ScheduleRow row;
  for (const std::uint64_t version : {100, 37, 40}) {
    row.versions[0] = version;
    ASSERT_TRUE(pair.graph.replayStep(RateGroup::kHaptic, {0, 0, 0.001}, row));
    EXPECT_EQ(pair.reader->way, static_cast<double>(version));
  }
  row.versions[0] = 36;  // 64 are kept
  EXPECT_FALSE(pair.graph.replayStep(RateGroup::kHaptic, {0, 0, 0.001}, row));
  EXPECT_EQ(guard.violations(), 0) << guard.first();
}

// The number of values in use may change at every step; the capacity does not.
TEST(SizedAtLoad, SnapConstraintsComeAndGoInTheRoomThatWasMade) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  SnapConstraints wanted;
  wanted.bodies.reserve(kBodies);
  LatestValue<SnapConstraints> latest(wanted);
  const RealTimeGuard guard;
  for (const std::size_t count : {std::size_t{0}, std::size_t{3}, kBodies, std::size_t{1}, kBodies}) {
    wanted.bodies.clear();
    for (std::size_t i = 0; i < count; ++i) wanted.bodies.emplace_back().body = static_cast<std::int32_t>(i);
    latest.publish(wanted, 0);
    ASSERT_TRUE(latest.update());
    ASSERT_EQ(latest.value().bodies.size(), count);
    if (count > 0) {
      EXPECT_EQ(latest.value().bodies.back().body, static_cast<std::int32_t>(count - 1));
    }
  }
  EXPECT_EQ(guard.violations(), 0) << guard.first();
}

}  // namespace
}  // namespace presa
