#include "framework/bus/sequence_watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "framework/core/math/random.h"

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

// One forged number, however placed, costs one sample: what follows is counted as if it had never been there.
TEST(SequenceWatch, OneForgedNumberLocksNothing) {
  for (const std::uint64_t forged :
       {~std::uint64_t{0}, std::uint64_t{0}, std::uint64_t{1} << 63U, std::uint64_t{102 + 1025}}) {
    SequenceWatch watch;
    for (const std::uint64_t number : {5000, 5001, 5002}) watch.see(number + (forged < 5000 ? 5000 : 0));
    const std::uint64_t base = watch.highest();
    EXPECT_EQ(watch.see(forged), Arrival::kStray) << forged;
    EXPECT_EQ(watch.highest(), base);
    EXPECT_EQ(watch.see(base + 1), Arrival::kNewest) << forged;
    EXPECT_EQ(watch.lost(), 0u);
  }
}

// Two forged ones in a row are believed, as after a long silence; two true ones later so are those, and no loss is made up.
TEST(SequenceWatch, GoesOnAfterTwoForgedNumbers) {
  SequenceWatch watch;
  for (std::uint64_t number = 1; number <= 10; ++number) watch.see(number);
  EXPECT_EQ(watch.see(~std::uint64_t{0} - 1), Arrival::kStray);
  EXPECT_EQ(watch.see(~std::uint64_t{0}), Arrival::kNewest);
  EXPECT_EQ(watch.see(11), Arrival::kStray);
  EXPECT_EQ(watch.see(12), Arrival::kNewest);
  EXPECT_EQ(watch.see(13), Arrival::kNewest);
  EXPECT_EQ(watch.lost(), 0u);
}

// The first number of all may be the forged one.
TEST(SequenceWatch, GoesOnWhenTheFirstNumberIsForged) {
  SequenceWatch watch;
  watch.see(~std::uint64_t{0});
  watch.see(1);
  EXPECT_EQ(watch.see(2), Arrival::kNewest);
  EXPECT_EQ(watch.see(3), Arrival::kNewest);
}

// Who was suspended for an hour goes on with the second sample, and has lost what it has lost.
TEST(SequenceWatch, GoesOnAfterALongSilence) {
  SequenceWatch watch;
  watch.see(1);
  EXPECT_EQ(watch.see(720'001), Arrival::kStray);
  EXPECT_EQ(watch.see(720'002), Arrival::kNewest);
  EXPECT_EQ(watch.lost(), 720'000u);  // the stray one was not shown
}

}  // namespace
}  // namespace presa::bus
