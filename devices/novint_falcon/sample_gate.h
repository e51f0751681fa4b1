#pragma once
#include <cstdint>

#include "devices/novint_falcon/packet.h"
#include "framework/core/math/spatial.h"

namespace presa::falcon {

/// Converts encoder counts to position and velocity, and rejects physically impossible samples. Thread: the link's;
/// nonblocking.
class SampleGate {
 public:
  enum class Verdict : std::uint8_t {
    kGood,
    kRejected,  ///< the previous sample stays valid
    kLatched,   ///< the second rejection in a row
  };

  /// `max_speed` [m/s]: a sample that is farther from the last good one than this speed allows is rejected. `period`:
  /// min time between two samples used for that check [s].
  SampleGate(double max_speed, double period) : max_speed_(max_speed), period_(period) {}

  /// Forgets position and velocity: homing moves the origin.
  void reset() noexcept;
  /// Reports that the reply to the request at `asked` has not come by `now`. If it still comes, it is attributed to a
  /// later request. For a while the age of samples is therefore uncertain: the velocity is zero, and the position may
  /// have changed since `asked`.
  void unsettle(double asked, double now) noexcept;
  /// `time`: when the encoders were read [s].
  Verdict take(const Counts& encoders, double time) noexcept;

  bool empty() const noexcept { return empty_; }
  const Vec3& position() const noexcept { return p_DH_; }
  const Vec3& velocity() const noexcept { return v_DH_; }
  std::uint64_t rejected() const noexcept { return rejected_; }

  /// Time constant of the velocity [s]: a step of one count (45 um in 1 ms) shows as 13 mm/s.
  static constexpr double kVelocityTime = 3e-3;
  /// After a pause longer than this, and for this long after a late reply, the velocity restarts from zero [s].
  static constexpr double kVelocityGap = 10e-3;

 private:
  double max_speed_, period_;
  Vec3 p_DH_ = Vec3::Zero(), v_DH_ = Vec3::Zero();
  double time_ = 0;
  double unsettled_since_ = 0, unsettled_until_ = -1;
  bool empty_ = true;
  bool doubted_ = false;  // the last sample was rejected
  std::uint64_t rejected_ = 0;
};

}  // namespace presa::falcon
