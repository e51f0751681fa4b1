#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <memory>
#include <thread>
#include <vector>

#include "framework/core/exchange/event_ring.h"
#include "framework/core/exchange/latest_value.h"
#include "framework/core/graph/graph_builder.h"

namespace presa {
namespace {

// 2 KiB, large enough that a torn copy would be seen.
struct Message {
  std::array<std::uint64_t, 256> words{};
};

// For any interleaving of the threads, no reader sees a torn value or an older value after a newer one, and the version
// belongs to the value. (Under tsan: no race either.)
template <std::size_t kReaders>
void expectWholeValuesInOrder() {
  LatestValue<Message, kReaders> latest({}, kReaders);
  constexpr std::uint64_t kCount = 200'000;
  std::atomic<std::uint64_t> torn{0}, backwards{0}, mislabelled{0};
  const auto read = [&](std::size_t reader) {
    std::uint64_t last = 0;
    while (last < kCount) {
      if (!latest.update(reader)) continue;
      const Published<Message>& seen = latest.latest(reader);
      const std::uint64_t value = seen.value.words[0];
      for (const std::uint64_t word : seen.value.words) torn += word != value ? 1 : 0;
      backwards += value <= last ? 1 : 0;
      mislabelled += seen.version != value || seen.time != static_cast<double>(value) ? 1 : 0;
      last = value;
    }
  };
  std::vector<std::thread> readers;
  for (std::size_t reader = 0; reader < kReaders; ++reader) readers.emplace_back(read, reader);
  Message message;
  for (std::uint64_t i = 1; i <= kCount; ++i) {
    message.words.fill(i);
    latest.publish(message, static_cast<double>(i));
  }
  for (std::thread& reader : readers) reader.join();
  EXPECT_EQ(torn, 0u);
  EXPECT_EQ(backwards, 0u);
  EXPECT_EQ(mislabelled, 0u);
}

TEST(LatestValue, ReaderNeverSeesTornOrOlderValue) { expectWholeValuesInOrder<1>(); }
TEST(LatestValue, ThreeReadersNeverSeeTornOrOlderValues) { expectWholeValuesInOrder<3>(); }

// A reader that takes nothing keeps its value and costs the others none of theirs.
TEST(LatestValue, EachReaderTakesWhenItLikes) {
  LatestValue<int, 2> latest(0, 2);
  for (int i = 1; i <= 20; ++i) {
    latest.publish(10 * i, i);
    ASSERT_TRUE(latest.update(0));
    ASSERT_EQ(latest.latest(0).value, 10 * i);
    if (i % 7 == 0) {
      ASSERT_TRUE(latest.update(1));
    }
    ASSERT_EQ(latest.latest(1).value, 10 * (i - i % 7));
  }
}

// Before the first publication there is nothing new, and version 0 says so.
TEST(LatestValue, IsEmptyUntilPublished) {
  LatestValue<Message> latest;
  EXPECT_FALSE(latest.update());
  EXPECT_EQ(latest.version(), 0u);
  latest.publish({}, 1.5);
  EXPECT_TRUE(latest.update());
  EXPECT_FALSE(latest.update());
  EXPECT_EQ(latest.version(), 1u);
}

/// Plain data that counts how often it is copied.
struct Counted {
  std::uint64_t number = 0;
  Counted() = default;
  Counted(const Counted&) = default;
  Counted& operator=(const Counted& other) {
    number = other.number;
    ++copies;
    return *this;
  }
  inline static int copies = 0;
};

struct TickSource final : Module {
  Out<Counted> out{*this, "count"};
  TickSource() : Module("source", RateGroup::kHaptic) {}
  void step(const Tick& tick) noexcept override { out.value.number = tick.index + 1; }
};

struct Watcher final : Module {
  In<Counted> in{*this, "count"};
  explicit Watcher(RateGroup group) : Module("watcher", group) {}
  void step(const Tick&) noexcept override {}
};

/// A source at 1 kHz, read at 50 Hz by `group`.
struct Watch {
  explicit Watch(RateGroup group) : reader(group) {
    GraphBuilder builder;
    builder.add(std::make_unique<TickSource>());
    watcher = &builder.add(std::make_unique<Watcher>(group));
    builder.connectByName();
    graph = builder.build();
    Counted::copies = 0;
  }
  void count(std::uint64_t tick) { graph.step(RateGroup::kHaptic, {tick, 1e-3 * static_cast<double>(tick), 1e-3}); }
  /// Copies until the tick 20 n, at which the watcher looks.
  int copiesUntilLook(std::uint64_t n) {
    const int before = Counted::copies;
    for (; next <= 20 * n; ++next) count(next);
    graph.step(reader, {n, 0.02 * static_cast<double>(n), 0.02});
    return Counted::copies - before;
  }
  RateGroup reader;
  Watcher* watcher = nullptr;
  Graph graph;
  std::uint64_t next = 0;
};

// A view sees the value of its own instant, with the number of the tick, although only two ticks of twenty are copied for
// it: the last one before it looks, in case that it is first, and the one at that instant.
TEST(Bridge, CopiesForAViewOnlyWhenItIsDue) {
  Watch watch(RateGroup::kView);
  watch.copiesUntilLook(0);
  for (std::uint64_t n = 1; n < 50; ++n) {
    ASSERT_EQ(watch.copiesUntilLook(n), 2) << n;
    ASSERT_EQ(watch.watcher->in->number, 20 * n + 1);
    ASSERT_EQ(watch.watcher->in.version(), 20 * n + 1);
  }
}

// A view that is late gets the latest value all the same.
TEST(Bridge, CopiesEveryTickForAViewThatIsLate) {
  Watch watch(RateGroup::kView);
  watch.copiesUntilLook(0);
  for (std::uint64_t tick = 1; tick < 38; ++tick) watch.count(tick);
  watch.graph.step(RateGroup::kView, {1, 0.02, 0.02});
  EXPECT_EQ(watch.watcher->in->number, 38U);
}

// Every value is there for the groups that a run's physics depends on, whenever they look.
TEST(Bridge, CopiesEveryTickForTheDynamics) {
  Watch watch(RateGroup::kDynamics);
  watch.copiesUntilLook(0);
  EXPECT_EQ(watch.copiesUntilLook(1), 20);
  EXPECT_EQ(watch.watcher->in->number, 21U);
}

// Events arrive in order, and every lost event is counted.
TEST(EventRing, KeepsOrderAndCountsWhatItDrops) {
  EventRing<int> ring(4);
  int accepted = 0;
  for (int i = 0; i < 10; ++i) accepted += ring.push(i) ? 1 : 0;
  EXPECT_EQ(static_cast<std::uint64_t>(10 - accepted), ring.dropped());
  EXPECT_GE(accepted, 4);
  int event = -1;
  for (int i = 0; i < accepted; ++i) {
    ASSERT_TRUE(ring.pop(event));
    EXPECT_EQ(event, i);
  }
  EXPECT_FALSE(ring.pop(event));
}

}  // namespace
}  // namespace presa
