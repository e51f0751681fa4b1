#include "framework/bus/sequence_watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "framework/math/random.h"

namespace presa::bus {
namespace {

using Arrival = SequenceWatch::Arrival;

TEST(SequenceWatch, CountsWhatIsMissingBetweenTheFirstAndTheHighest) {
  SequenceWatch watch;
  EXPECT_EQ(watch.lost(), 0u);
  EXPECT_EQ(watch.see(100), Arrival::kNewest);  // joins late: 1 to 99 are nobody's loss
  EXPECT_EQ(watch.lost(), 0u);
  EXPECT_EQ(watch.see(103), Arrival::kNewest);
  EXPECT_EQ(watch.lost(), 2u);
  EXPECT_EQ(watch.see(102), Arrival::kLate);
  EXPECT_EQ(watch.lost(), 1u);
  EXPECT_EQ(watch.see(102), Arrival::kDouble);
  EXPECT_EQ(watch.see(103), Arrival::kDouble);
  EXPECT_EQ(watch.see(99), Arrival::kDouble);
  EXPECT_EQ(watch.lost(), 1u);
  EXPECT_EQ(watch.lostUpTo(110), 8u);
  EXPECT_EQ(watch.received(), 3u);
}

// Against a set that remembers everything: numbers lost, doubled and up to 40 places out of order.
TEST(SequenceWatch, AgreesWithASetThatRemembersAll) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomStream random(seed, "numbers");
    std::vector<std::pair<double, std::uint64_t>> sent;
    for (std::uint64_t n = 1; n <= 5000; ++n) {
      if (random.uniform() < 0.1 && n > 1) continue;
      const double place = static_cast<double>(n) + (random.uniform() < 0.2 && n > 1 ? random.uniform(0, 40) : 0);
      sent.emplace_back(place, n);
      if (random.uniform() < 0.1) sent.emplace_back(place + random.uniform(0, 5), n);
    }
    std::ranges::stable_sort(sent, {}, &std::pair<double, std::uint64_t>::first);
    SequenceWatch watch;
    std::set<std::uint64_t> seen;
    for (const auto& [place, number] : sent) {
      const bool fresh = seen.insert(number).second;
      EXPECT_EQ(watch.see(number) != Arrival::kDouble, fresh) << number;
      EXPECT_EQ(watch.lost(), *seen.rbegin() - *seen.begin() + 1 - seen.size());
    }
  }
}

}  // namespace
}  // namespace presa::bus
