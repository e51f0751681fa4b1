#pragma once
#include <cstdint>
#include <map>
#include <vector>

namespace presa::cost {

/// Forecast of the remaining time of a study from the durations of its runs so far. The expected duration of a timed
/// run is that of the previous timed run of the same setting, or else that of its watched run times the mean ratio so
/// far.
class Forecast {
 public:
  /// Watched and counted runs run `workers` at a time, timed runs one at a time.
  explicit Forecast(int workers) : workers_(workers) {}
  enum class Kind { kWatched, kTimed, kCounted };
  struct Run {
    Kind kind = Kind::kWatched;
    std::uint64_t setting = 0;
  };
  void add(Run run) { ++left_[{run.setting, run.kind}]; }
  /// One of the added runs is finished, after `seconds`; `seconds` < 0: its result existed already.
  void done(Run run, double seconds);
  /// Remaining time [s]; negative while it is unknown.
  double left() const;

 private:
  using Key = std::pair<std::uint64_t, Kind>;
  double expected(const Key& key) const;
  int workers_;
  std::map<Key, int> left_;
  std::map<Key, double> took_;
};

}  // namespace presa::cost
