#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <utility>

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
  static constexpr std::array<Kind, 3> kKinds{Kind::kWatched, Kind::kTimed, Kind::kCounted};
  /// Of the runs of one kind that are done, and of the watched runs of their settings.
  struct Sums {
    int count = 0, pairs = 0;
    double seconds = 0, paired = 0, watched = 0;  ///< [s]
  };
  double expected(const Key& key) const;
  /// Adds the runs of a setting to the sums; sign -1 takes them off.
  void sumUp(std::uint64_t setting, int sign);
  Sums& sumsOf(Kind kind) { return sums_[static_cast<std::size_t>(kind)]; }
  int workers_;
  std::array<Sums, kKinds.size()> sums_{};  // by Kind
  std::map<Key, int> left_;
  std::map<Key, double> took_;
};

}  // namespace presa::cost
