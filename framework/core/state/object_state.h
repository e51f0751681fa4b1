#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "framework/core/math/spatial.h"
#include "framework/core/state/limits.h"

namespace presa {

/// Motion of one body over one dynamics step.
struct BodyMotion {
  Pose X_WB_begin;           ///< pose at ObjectState::time_begin
  Pose X_WB_end;             ///< pose at ObjectState::time_end
  Vec3 v_WB = Vec3::Zero();  ///< velocity of the body frame's origin at time_end [m/s]
  Vec3 w_WB = Vec3::Zero();  ///< angular velocity at time_end [rad/s]
  bool asleep = false;
};

/// What can go wrong in the dynamics (ObjectState::faults).
enum ObjectFault : std::uint32_t {
  kFaultBodyFrozen = 1,    ///< a body's state was not finite or beyond reason: it stands still now
  kFaultEngineFailed = 2,  ///< the engine gave up: every body stands still
  kFaultBadFinger = 4,     ///< a finger contact made no sense: ignored
};

/// How deep bodies stand in each other: over the contact points between two bodies, fixed ones included and fingers not, from which the
/// step just solved started (its last sub-step). What sleeps on what sleeps or is fixed is not looked at, and not counted.
struct BodyPenetration {
  static constexpr std::int32_t kUnknown = -1;
  std::int32_t points = kUnknown;  ///< kUnknown: the engine does not say, and the depths are NaN
  double mean = std::numeric_limits<double>::quiet_NaN();   ///< [m]; 0 where nothing touches
  double worst = std::numeric_limits<double>::quiet_NaN();  ///< [m]; 0 where nothing touches
};

/// Object State: every body of the scene (fixed ones too, in scene order), over the step just solved.
/// It says for which time it is valid; a reader interpolates to its own "now", so that no pose jumps
/// ahead when it is published (a jump of one 5 ms step costs a factor five in stable stiffness).
/// A default one has no bodies; the dynamics has sized it by the scene before the first step, and its length stays.
/// Written by: dynamics thread.
struct ObjectState {
  double time_begin = 0;     ///< [s]
  double time_end = 0;       ///< [s], time_begin + dynamics period
  std::uint32_t faults = 0;  ///< ObjectFault bits since the start; forces fade for good when any is set
  /// Steps since the start in which an island had to change from the direct to the iterative solver.
  std::uint64_t fallback_steps = 0;
  BodyPenetration penetration;
  /// By finger: what it gave to the bodies since the start, in W [N s]. Its difference over a time is the mean force.
  std::array<Vec3, kMaxFingers> finger_impulse_W;
  std::vector<BodyMotion> bodies;

  ObjectState() { finger_impulse_W.fill(Vec3::Zero()); }

  std::int32_t count() const noexcept { return static_cast<std::int32_t>(bodies.size()); }
  /// Memory beside the struct itself (SizedAtLoad).
  std::size_t roomBytes() const noexcept { return bodies.capacity() * sizeof(BodyMotion); }

  /// Pose of body i, one of those there are, at time t; t outside [time_begin, time_end] is held at the nearer end.
  Pose poseAt(std::int32_t i, double t) const {
    const BodyMotion& body = bodies[static_cast<std::size_t>(i)];
    const double span = time_end - time_begin;
    if (!(span > 0)) return body.X_WB_end;
    return interpolate(body.X_WB_begin, body.X_WB_end, std::clamp((t - time_begin) / span, 0.0, 1.0));
  }
};

}  // namespace presa
