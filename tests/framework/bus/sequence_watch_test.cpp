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
  EXPECT_EQ(watch.see(100), Arrival::kNewest);  // joins late: 1 to 99 are not counted as loss
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

// Oracle: a set of all numbers. Losses, duplicates and reordering by up to 40 places.
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

// One forged number, wherever it lies, costs one sample; later counts are unaffected.
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

// Two consecutive forged numbers are accepted, as after a long silence; two genuine ones later restore the count
// without loss.
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

// The very first number may be forged.
TEST(SequenceWatch, GoesOnWhenTheFirstNumberIsForged) {
  SequenceWatch watch;
  watch.see(~std::uint64_t{0});
  watch.see(1);
  EXPECT_EQ(watch.see(2), Arrival::kNewest);
  EXPECT_EQ(watch.see(3), Arrival::kNewest);
}

// After an hour's suspension counting resumes with the second sample, and the loss is counted.
TEST(SequenceWatch, GoesOnAfterALongSilence) {
  SequenceWatch watch;
  watch.see(1);
  EXPECT_EQ(watch.see(720'001), Arrival::kStray);
  EXPECT_EQ(watch.see(720'002), Arrival::kNewest);
  EXPECT_EQ(watch.lost(), 720'000u);  // the stray sample was not shown
}

}  // namespace
}  // namespace presa::bus
