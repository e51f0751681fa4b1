#pragma once
#include <string>
#include <vector>

#include "framework/core/state/device_state.h"

namespace presa {

/// The recorded motion of one finger over the time since its first row. Immutable after reading, shared by its readers.
struct RecordedPath {
  struct Row {
    double time = 0;  ///< since the first [s]
    FingerInput sample;
  };
  std::vector<Row> rows;  ///< not empty, in ascending time
  double period = 0;      ///< recorded haptic period [s]

  double end() const { return rows.back().time + period; }
  bool hasPhases() const;
};

/// Reads a path from start to end. Thread: haptic; nonblocking.
class PathReader {
 public:
  PathReader(const RecordedPath& path, double speed) : path_(path), speed_(speed) {}

  bool ended(double time) const noexcept { return time * speed_ > path_.end() - kSameInstant; }
  /// The sample at a time [s], which must not decrease: bit-identical to a row at its time, linearly interpolated
  /// between two valid rows, otherwise the row before.
  FingerInput at(double time) noexcept;
  /// The last position, at rest.
  FingerInput last() const noexcept;
  void rewind() noexcept { row_ = 0; }

  static constexpr double kSameInstant = 1e-9;  ///< [s]: periods are whole nanoseconds

 private:
  const RecordedPath& path_;
  double speed_;
  std::size_t row_ = 0;
};

}  // namespace presa
