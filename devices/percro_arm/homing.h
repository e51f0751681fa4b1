#pragma once
#include <array>

#include "devices/percro_arm/kinematics.h"

namespace presa::percro {

/// Where on the transmission the markers sit: a marker is covered while its joint lies above. GUESS: the paper prints none.
struct Markers {
  Joints at{0.05, -0.04, 0.15};
  double hysteresis = 0.2e-3;  ///< of a switch [rad], [m]: it goes off that much below where it comes on
};

/// The first calibration of [Bergamasco2006 2.2]: one joint after the other (barrel, tilt, yaw) is driven slowly to its marker and
/// then over its edge a few times from either side, while the others are held. The mean of edges met upwards and downwards
/// cancels the switch's hysteresis and the delay of a tick. Thread: haptic; nothing allocates.
class Homing {
 public:
  enum class Failure {
    kNone,
    kBlocked,   ///< a joint does not follow: something holds it
    kNoMarker,  ///< no edge within a joint's range
    kUnsteady   ///< edges of one direction lie apart: the transmission slips
  };

  Homing(const Parameters& parameters, const Markers& markers, double period);

  /// One period: joints as the encoders tell them from an unknown zero, their rates, and which markers are covered. Returns the
  /// joint torques to command.
  Vec3 step(const Joints& told, const Vec3& rates, const std::array<bool, 3>& covered) noexcept;

  bool done() const noexcept { return turn_ == 3; }
  Failure failure() const noexcept { return failure_; }
  int failedJoint() const noexcept { return kOrder[turn_ < 3 ? turn_ : 2]; }
  /// What the encoders tell at q = 0, of done joints.
  const Joints& offset() const noexcept { return offset_; }

 private:
  static constexpr std::array<int, 3> kOrder{2, 0, 1};
  static constexpr int kPasses = 4;  // over the edge in each direction

  void meetEdge(int joint, double told, bool covered) noexcept;
  double setpointRate(int joint, double told, bool covered) noexcept;

  Parameters parameters_;
  Markers markers_;
  double period_;
  Vec3 stiffness_, damping_, integral_gain_;
  Joints setpoint_ = Joints::Zero(), offset_ = Joints::Zero();
  Vec3 integral_ = Vec3::Zero();
  bool started_ = false, was_covered_ = false;
  int turn_ = 0, edges_ = 0;  // which joint of kOrder, how often its edge was met
  double direction_ = 0, travelled_ = 0, last_edge_ = 0;
  std::array<double, 2> sum_{}, low_{}, high_{};  // of edges met downwards, upwards
  Failure failure_ = Failure::kNone;
};

}  // namespace presa::percro
