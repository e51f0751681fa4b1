#pragma once
#include <array>

#include "devices/percro_arm/kinematics.h"

namespace presa::percro {

/// Positions of the markers on the transmission; a marker is covered while its joint is above it. GUESS: not published.
struct Markers {
  Joints at{0.05, -0.04, 0.15};
  double hysteresis = 0.2e-3;  ///< of a switch [rad], [m]: the switch-off point is this far below the switch-on point
};

/// The first calibration of [Bergamasco2006 2.2]. One joint after the other (barrel, tilt, yaw) moves slowly to its
/// marker and several times over its edge from both sides, while the others are held. The mean of upward and downward
/// edges cancels the hysteresis of the switch and the delay of a tick. Thread: haptic; nothing allocates.
class Homing {
 public:
  enum class Failure {
    kNone,
    kBlocked,   ///< a joint does not follow its setpoint
    kNoMarker,  ///< no edge within the range of a joint
    kUnsteady   ///< edges of one direction differ: the transmission slips
  };

  Homing(const Parameters& parameters, const Markers& markers, double period);

  /// One period. Inputs: joints by the encoders with unknown zero, their rates, and the covered markers. Returns the
  /// joint torques to command.
  Vec3 step(const Joints& told, const Vec3& rates, const std::array<bool, 3>& covered) noexcept;

  bool done() const noexcept { return turn_ == 3; }
  Failure failure() const noexcept { return failure_; }
  int failedJoint() const noexcept { return kOrder[turn_ < 3 ? turn_ : 2]; }
  /// Encoder readings at q = 0, for the joints that are done.
  const Joints& offset() const noexcept { return offset_; }

 private:
  static constexpr std::array<int, 3> kOrder{2, 0, 1};
  static constexpr int kPasses = 4;  // over the edge, per direction

  void meetEdge(int joint, double told, bool covered) noexcept;
  double setpointRate(int joint, double told, bool covered) noexcept;

  Parameters parameters_;
  Markers markers_;
  double period_;
  Vec3 stiffness_, damping_, integral_gain_;
  Joints setpoint_ = Joints::Zero(), offset_ = Joints::Zero();
  Vec3 integral_ = Vec3::Zero();
  bool started_ = false, was_covered_ = false;
  int turn_ = 0, edges_ = 0;  // index into kOrder; edges met so far
  double direction_ = 0, travelled_ = 0, last_edge_ = 0;
  std::array<double, 2> sum_{}, low_{}, high_{};  // of downward and upward edges
  Failure failure_ = Failure::kNone;
};

}  // namespace presa::percro
