#include "apps/studies/cost/forecast.h"

#include <algorithm>

namespace presa::cost {

void Forecast::done(Run run, double seconds) {
  const Key key{run.setting, run.kind};
  left_[key] = std::max(0, left_[key] - 1);
  if (seconds < 0) return;
  sumUp(run.setting, -1);
  took_[key] = seconds;
  sumUp(run.setting, 1);
}

void Forecast::sumUp(std::uint64_t setting, int sign) {
  const auto watched = took_.find({setting, Kind::kWatched});
  for (const Kind kind : kKinds) {
    const auto run = took_.find({setting, kind});
    if (run == took_.end()) continue;
    Sums& sums = sumsOf(kind);
    sums.count += sign;
    sums.seconds += sign * run->second;
    if (watched == took_.end()) continue;
    sums.pairs += sign;
    sums.paired += sign * run->second;
    sums.watched += sign * watched->second;
  }
}

// Expected duration of a run [s]; negative: unknown. Before the first counted run has ended, a counted run is assumed
// to take fifty times as long as a watched one.
double Forecast::expected(const Key& key) const {
  if (const auto same = took_.find(key); same != took_.end()) return same->second;
  const Sums& sums = sums_[static_cast<std::size_t>(key.second)];
  const auto own = took_.find({key.first, Kind::kWatched});
  if (key.second != Kind::kWatched && own != took_.end()) {
    const double untold = key.second == Kind::kCounted ? 50 : 1;
    return own->second * (sums.pairs > 0 && sums.watched > 0 ? sums.paired / sums.watched : untold);
  }
  return sums.count > 0 ? sums.seconds / sums.count : -1;
}

double Forecast::left() const {
  double parallel = 0, alone = 0;
  int unknown = 0, unknown_parallel = 0;
  for (const auto& [key, runs] : left_) {
    if (runs == 0) continue;
    const double each = expected(key);
    const bool one_at_a_time = key.second == Kind::kTimed;
    if (each < 0) {
      unknown += runs;
      unknown_parallel += one_at_a_time ? 0 : runs;
      continue;
    }
    (one_at_a_time ? alone : parallel) += runs * each;
  }
  double known = 0;
  for (const Sums& sums : sums_) known += sums.seconds;
  if (took_.empty()) return -1;
  const double mean = known / static_cast<double>(took_.size());
  parallel += unknown_parallel * mean;
  alone += (unknown - unknown_parallel) * mean;
  return parallel / workers_ + alone;
}

}  // namespace presa::cost
