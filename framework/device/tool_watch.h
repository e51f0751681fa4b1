#pragma once
#include <cstdint>

#include "framework/device/pose_return.h"

namespace presa {

/// The motion of a tool that carries frames and devices, without jumps. While the tool has no usable sample it stands
/// still; from then on, and after a jump that no hand makes, the offset to what is measured fades (PoseReturn).
/// Thread: haptic; nonblocking.
class ToolWatch {
 public:
  static constexpr double kLongest = 0.1;  ///< longer without a sample: lost [s]

  /// At `time` [s], which never goes back. `measured` counts only if `valid`, finite and a pose.
  void update(const FrameMotion& measured, bool valid, double time) noexcept;
  /// For pictures: there it is.
  void put(const FrameMotion& motion) noexcept { motion_ = motion; }
  const FrameMotion& motion() const noexcept { return motion_; }  ///< as shown now
  /// A sample has come. Before, nobody knows where it is.
  bool known() const noexcept { return known_; }
  bool lost() const noexcept { return lost_; }  ///< stands still: no usable sample for longer than kLongest
  /// It was lost, and is on its way back.
  bool returns() const noexcept { return returns_; }
  /// How often it was lost so far.
  std::uint32_t losses() const noexcept { return losses_; }

 private:
  bool jumped(const Pose& measured, double time) const noexcept;

  FrameMotion motion_;
  PoseReturn back_;
  Pose last_;             // measured
  double last_time_ = 0;  // [s]
  bool known_ = false, missed_ = false, lost_ = false, returns_ = false;
  std::uint32_t losses_ = 0;
};

}  // namespace presa
