#pragma once
#include <cstdint>
#include <map>
#include <vector>

namespace presa::cost {

/// How long the rest of a study will take, from what its runs have taken so far. A timed run is expected to take as long
/// as the timed run of the same setting before, else as its watched run in the proportion seen so far.
class Forecast {
 public:
  /// What is still to be made: watched and counted runs by `workers` at a time, timed runs one at a time.
  explicit Forecast(int workers) : workers_(workers) {}
  enum class Kind { kWatched, kTimed, kCounted };
  struct Run {
    Kind kind = Kind::kWatched;
    std::uint64_t setting = 0;
  };
  void add(Run run) { ++left_[{run.setting, run.kind}]; }
  /// One of the runs added is there; `seconds` < 0: it was there already.
  void done(Run run, double seconds);
  /// [s]; negative as long as nothing is known.
  double left() const;

 private:
  using Key = std::pair<std::uint64_t, Kind>;
  double expected(const Key& key) const;
  int workers_;
  std::map<Key, int> left_;
  std::map<Key, double> took_;
};

}  // namespace presa::cost
