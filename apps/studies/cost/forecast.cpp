#include "apps/studies/cost/forecast.h"

#include <algorithm>

namespace presa::cost {

void Forecast::done(Run run, double seconds) {
  const Key key{run.setting, run.kind};
  left_[key] = std::max(0, left_[key] - 1);
  if (seconds >= 0) took_[key] = seconds;
}

// Expected duration of a run [s]; negative: unknown. Before the first counted run has ended, a counted run is assumed
// to take fifty times as long as a watched one.
double Forecast::expected(const Key& key) const {
  if (const auto same = took_.find(key); same != took_.end()) return same->second;
  double sum = 0, watched = 0, all = 0;
  int count = 0, pairs = 0;
  for (const auto& [other, seconds] : took_) {
    if (other.second != key.second) continue;
    sum += seconds;
    ++count;
    if (const auto pair = took_.find({other.first, Kind::kWatched}); pair != took_.end()) {
      all += seconds;
      watched += pair->second;
      ++pairs;
    }
  }
  const auto own = took_.find({key.first, Kind::kWatched});
  if (key.second != Kind::kWatched && own != took_.end()) {
    const double untold = key.second == Kind::kCounted ? 50 : 1;
    return own->second * (pairs > 0 && watched > 0 ? all / watched : untold);
  }
  return count > 0 ? sum / count : -1;
}

double Forecast::left() const {
  double parallel = 0, alone = 0, known = 0;
  int count = 0, unknown = 0, unknown_parallel = 0;
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
  for (const auto& [key, seconds] : took_) {
    known += seconds;
    ++count;
  }
  if (count == 0) return -1;
  const double mean = known / count;
  parallel += unknown_parallel * mean;
  alone += (unknown - unknown_parallel) * mean;
  return parallel / workers_ + alone;
}

}  // namespace presa::cost
