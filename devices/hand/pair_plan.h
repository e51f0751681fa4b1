#pragma once
#include "framework/core/math/spatial.h"
#include "framework/core/state/object_state.h"

namespace presa {

/// Target of a pair of fingertips, in W.
struct PairTarget {
  Vec3 centre = Vec3::Zero();  ///< midpoint between the fingertip centres [m]
  double yaw = 0;              ///< direction of the line from thumb to index [rad]
  double gap = 0;              ///< from the midpoint to each fingertip centre [m]
  double grip = 0;             ///< force towards each other [N]; 0: position control
};

/// The plan of a pair of fingers, movement by movement. It is a function of the observed states only, so each finger
/// may run its own copy. Thread: haptic; no allocation after construction.
class PairPlan {
 public:
  virtual ~PairPlan() = default;

  /// Observes the bodies; call at every tick, before at().
  void see(const ObjectState& objects, double time) noexcept;
  /// The target at a time within the tick that was observed last.
  PairTarget at(double time) const noexcept;
  /// Time derivative of at() [1/s].
  PairTarget rate(double time) const noexcept;
  int phase() const noexcept { return phase_; }

 protected:
  explicit PairPlan(const PairTarget& start) : from_(start), to_(start) {}
  /// Called when a movement has ended: chooses the next one.
  virtual void next(const ObjectState& objects) noexcept = 0;

  /// Starts a minimum-jerk movement from the end of the last one; a new grip ramps up from zero.
  void go(int phase, const PairTarget& to, double duration) noexcept;
  /// Same, with a max speed of `speed` [m/s] and of 1 rad/s for the rotation.
  void goAt(int phase, const PairTarget& to, double speed) noexcept;
  const PairTarget& target() const noexcept { return to_; }
  double now() const noexcept { return now_; }

 private:
  int phase_ = 0;
  PairTarget from_, to_;
  double begin_ = 0, end_ = 0, now_ = 0;
};

}  // namespace presa
