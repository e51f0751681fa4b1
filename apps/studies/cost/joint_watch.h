#pragma once
#include "apps/studies/cost/evidence.h"
#include "framework/core/state/object_state.h"
#include "framework/scene/joints/joint_motion.h"

namespace presa::cost {

/// Measures how far the joints of a scene are open in their locked directions, from poses alone, so that all engines
/// are judged alike. Call observe() with every dynamics step, in order.
class JointWatch {
 public:
  /// `scene` must outlive this; `evidence` provides the compared window.
  JointWatch(const Scene& scene, const Evidence& evidence);
  void observe(const ObjectState& objects);
  /// Writes joint_gap and joint_tilt of a scene with joints.
  void finish(Evidence& evidence) const;

 private:
  JointMotion motion_;
  double from_, to_;
  std::size_t bodies_, steps_ = 0;
  JointOpening widest_;  ///< over joints and steps, distance and angle each
};

}  // namespace presa::cost
