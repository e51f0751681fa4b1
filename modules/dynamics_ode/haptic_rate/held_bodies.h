#pragma once
#include <cstdint>

#include "framework/core/exchange/bounded_list.h"
#include "framework/core/state/object_state.h"
#include "framework/haptics/body_hits.h"

namespace presa::ode {

/// A body that the haptic thread moves, at HeldBodies::time.
struct HeldBody {
  /// Held: the haptic thread integrates it, and the dynamics follow. Leaving: the dynamics are asked to take it over, and
  /// the haptic thread integrates it until they have. Given back: the dynamics move it; what the haptic thread shows
  /// approaches their pose smoothly.
  enum class Phase : std::uint8_t { kHeld, kLeaving, kGivenBack };
  std::int32_t body = kNoBody;
  Phase phase = Phase::kHeld;
  double since = 0;  ///< when the haptic thread took it [s]
  Pose X_WB;
  Vec3 v_WB = Vec3::Zero();  ///< velocity of the body frame's origin [m/s]
  Vec3 w_WB = Vec3::Zero();  ///< [rad/s]

  /// Its pose `dt` later, at constant velocities.
  Pose poseAfter(double dt) const {
    const double angle = dt * w_WB.norm();
    const Quat turn(angle > 0 ? Eigen::AngleAxisd(angle, w_WB.normalized()) : Eigen::AngleAxisd::Identity());
    return {X_WB.p + dt * v_WB, (turn * X_WB.q).normalized()};
  }
};

/// Bodies that the haptic thread moves at its own rate while fingers hold them, with what stands on them or holds them,
/// for the dynamics to follow. Written by: haptic thread, before the tick's forces are rendered.
struct HeldBodies {
  double time = 0;               ///< [s]
  BoundedList<HeldBody> bodies;  ///< each at most once
  /// Bodies whose group is too large, until it is tried again: on these alone do fingers act in the dynamics.
  BoundedList<std::int32_t> refused;
  std::uint64_t taken = 0;     ///< since the start: bodies taken over from the dynamics
  std::uint64_t too_many = 0;  ///< since the start: how often a group was too large: not taken over, or given back
  /// What the steps of these bodies counted: impulses of fingers, contacts, energy, faults. Holds no bodies.
  ObjectState counted;
  BodyHits hits;  ///< of these bodies; without room in scenes where nobody listens

  /// Heap memory that it owns [bytes] (SizedAtLoad).
  std::size_t roomBytes() const noexcept {
    return bodies.roomBytes() + refused.roomBytes() + counted.roomBytes() + hits.roomBytes();
  }
};

inline constexpr const char* kHeldBodiesPort = "held_bodies";

}  // namespace presa::ode
