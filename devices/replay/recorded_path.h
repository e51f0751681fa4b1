#pragma once
#include <string>
#include <vector>

#include "framework/core/state/device_state.h"

namespace presa {

/// Where one finger of a recording was, over the time since its first row. Immutable after reading, shared by whoever replays it.
struct RecordedPath {
  struct Row {
    double time = 0;  ///< since the first [s]
    FingerInput sample;
  };
  std::vector<Row> rows;  ///< not empty; times rise
  double period = 0;      ///< of the haptic ticks that were recorded [s]

  double end() const { return rows.back().time + period; }
  bool hasPhases() const;
};

/// Reads a path from its begin to its end. Thread: haptic; nonblocking.
class PathReader {
 public:
  PathReader(const RecordedPath& path, double speed) : path_(path), speed_(speed) {}

  bool ended(double time) const noexcept { return time * speed_ > path_.end() - kSameInstant; }
  /// The sample at a time [s] that never goes back: a recorded one to the bit where the times agree, else on the straight line between
  /// two usable ones, else the one before.
  FingerInput at(double time) noexcept;
  /// The last place, at rest.
  FingerInput last() const noexcept;
  void rewind() noexcept { row_ = 0; }

  static constexpr double kSameInstant = 1e-9;  ///< [s]: periods are whole nanoseconds

 private:
  const RecordedPath& path_;
  double speed_;
  std::size_t row_ = 0;
};

}  // namespace presa
