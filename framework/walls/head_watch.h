#pragma once
#include <cstdint>
#include <string>

#include "framework/device/pose_return.h"

namespace presa::walls {

/// The pose of a tracked head, without jumps. While the tracker gives nothing usable, the head stays where it was;
/// when the tracker is back, the offset to what is measured fades along a minimum-jerk path of kReturn. A measured jump
/// that no head makes begins such a path, too. Thread: one.
class HeadWatch {
 public:
  static constexpr double kReturn = PoseReturn::kTime;  ///< [s]
  static constexpr double kFastest = 5;                 ///< no head moves faster [m/s]
  static constexpr double kLongest = 0.1;               ///< longer without a sample: the tracker is lost [s]

  /// `rest`: where the head is before the first sample.
  explicit HeadWatch(const Pose& rest) : pose_(rest) {}

  /// The head at `time` [s], which never goes back. `measured` counts only if `valid` and finite.
  const Pose& update(const Pose& measured, bool valid, double time) noexcept;
  const Pose& pose() const noexcept { return pose_; }
  bool lost() const noexcept { return lost_; }
  /// How often it was lost so far.
  std::uint32_t losses() const noexcept { return losses_; }

 private:
  bool jumped(const Pose& measured, double time) const noexcept;

  Pose pose_, last_;
  PoseReturn back_;
  double last_time_ = 0;
  bool lost_ = true, known_ = false;
  std::uint32_t losses_ = 0;
};

}  // namespace presa::walls
