#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "framework/core/math/spatial.h"
#include "framework/core/state/limits.h"

namespace presa {

/// Snap constraint: pulls a body to a pose, or fixes it there. The target velocity is `rate` times the remaining
/// distance, at most `speed`; the force along each of three axes (one of them the direction to the target) is at most
/// mass * `max_acceleration`. The rotation is treated likewise, measured at the body's rim. Limits are accelerations,
/// so that light and heavy bodies move alike. The dynamics solves it together with contact and friction.
struct SnapConstraint {
  std::int32_t body = kNoBody;
  bool fixed = false;           ///< carries the body to the pose and holds it there until the constraint is removed
  bool turns = true;            ///< the orientation is pulled, too
  Pose X_WB;                    ///< target pose of the body
  double rate = 0;              ///< [1/s]
  double speed = 0;             ///< maximum speed [m/s]; if `fixed`, minimum speed while it is carried
  double max_acceleration = 0;  ///< maximum acceleration [m/s^2]
};

/// The snap constraints of this moment; bodies not listed are free. Written by: collision thread (modules/assembly).
struct SnapConstraints {
  double time = 0;                     ///< [s]
  std::vector<SnapConstraint> bodies;  ///< number varies; capacity reserved at load

  SnapConstraints() = default;
  SnapConstraints(const SnapConstraints& other) { *this = other; }
  /// Also copies the capacity, so that the copy never has to allocate when the original grows.
  SnapConstraints& operator=(const SnapConstraints& other) {
    bodies.reserve(other.bodies.capacity());
    bodies = other.bodies;
    time = other.time;
    return *this;
  }

  /// Memory outside the struct itself (SizedAtLoad).
  std::size_t roomBytes() const noexcept { return bodies.capacity() * sizeof(SnapConstraint); }
};

}  // namespace presa
