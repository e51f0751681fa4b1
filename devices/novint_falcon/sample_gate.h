#pragma once
#include <cstdint>

#include "devices/novint_falcon/packet.h"
#include "framework/core/math/spatial.h"

namespace presa::falcon {

/// From encoder counts to a position and velocity that a hand can have: what cannot be is not passed on.
/// Thread: the link's; nonblocking.
class SampleGate {
 public:
  enum class Verdict : std::uint8_t {
    kGood,
    kRejected,  ///< the sample before holds on
    kLatched,   ///< the second in a row
  };

  /// `max_speed` [m/s]: a sample further away than that from the last good one is rejected. `period`: least time between
  /// two samples that counts [s].
  SampleGate(double max_speed, double period) : max_speed_(max_speed), period_(period) {}

  /// Forgets where the grip was and how fast: homing moves the origin.
  void reset() noexcept;
  /// A reply to what was asked at `asked` is late at `now`: if it still comes it is taken for that of a later request. For a while it
  /// cannot be told how old a sample is, so there is no velocity, and the grip may have moved since `asked`.
  void unsettle(double asked, double now) noexcept;
  /// `time`: when the encoders were read [s].
  Verdict take(const Counts& encoders, double time) noexcept;

  bool empty() const noexcept { return empty_; }
  const Vec3& position() const noexcept { return p_DH_; }
  const Vec3& velocity() const noexcept { return v_DH_; }
  std::uint64_t rejected() const noexcept { return rejected_; }

  /// Time constant of the velocity [s]: a step of one count (45 um in 1 ms) shows as 13 mm/s.
  static constexpr double kVelocityTime = 3e-3;
  /// After a pause longer than this, and for so long after a late reply, the velocity starts from zero [s].
  static constexpr double kVelocityGap = 10e-3;

 private:
  double max_speed_, period_;
  Vec3 p_DH_ = Vec3::Zero(), v_DH_ = Vec3::Zero();
  double time_ = 0;
  double unsettled_since_ = 0, unsettled_until_ = -1;
  bool empty_ = true;
  bool doubted_ = false;  // the last one was rejected
  std::uint64_t rejected_ = 0;
};

}  // namespace presa::falcon
