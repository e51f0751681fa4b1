#pragma once
#include "framework/core/math/spatial.h"
#include "framework/core/state/object_state.h"

namespace presa {

/// Where both fingertips of a pair are wanted, and how they press.
struct PairTarget {
  Vec3 centre = Vec3::Zero();  ///< between the fingertips' centres [m]
  double yaw = 0;              ///< of the line from thumb to index [rad]
  double gap = 0;              ///< from the centre to each fingertip's centre [m]
  double grip = 0;             ///< towards each other [N]; 0: they go where they are wanted
};

/// What a pair of fingers does, movement by movement. The same states give the same plan, so each finger of the pair may have one of its
/// own. Thread: haptic; no memory after construction.
class PairPlan {
 public:
  virtual ~PairPlan() = default;

  /// At every tick, before at().
  void see(const ObjectState& objects, double time) noexcept;
  /// Within the tick that was seen last.
  PairTarget at(double time) const noexcept;
  /// Change of at() [1/s].
  PairTarget rate(double time) const noexcept;
  int phase() const noexcept { return phase_; }

 protected:
  explicit PairPlan(const PairTarget& start) : from_(start), to_(start) {}
  /// The last movement has ended: chooses the one that begins now.
  virtual void next(const ObjectState& objects) noexcept = 0;

  /// A minimum-jerk movement from where the last one ends; a grip that begins rises from zero.
  void go(int phase, const PairTarget& to, double duration) noexcept;
  /// At most that fast [m/s], and turning with a radian a second.
  void goAt(int phase, const PairTarget& to, double speed) noexcept;
  const PairTarget& target() const noexcept { return to_; }
  double now() const noexcept { return now_; }

 private:
  int phase_ = 0;
  PairTarget from_, to_;
  double begin_ = 0, end_ = 0, now_ = 0;
};

}  // namespace presa
