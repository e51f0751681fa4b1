#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <thread>
#include <vector>

#include "framework/core/exchange/event_ring.h"
#include "framework/core/exchange/latest_value.h"

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
