#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "framework/core/math/spatial.h"
#include "framework/core/state/limits.h"

namespace presa {

/// Where a body is drawn to, or put for good. It is made to move there at `rate` times the way that is left, no faster than `speed`, with
/// at most mass · `most` along each of three axes, one of them the way; a turn likewise, at the body's rim. In
/// accelerations, so that light and heavy bodies follow alike. The dynamics solves it together with contact and friction.
struct Attraction {
  std::int32_t body = kNoBody;
  bool fixed = false;  ///< it is carried to the pose and stands there, as a fixed body would, until this is gone
  bool turns = true;   ///< its orientation is drawn, too
  Pose X_WB;           ///< of the body, where it belongs
  double rate = 0;     ///< [1/s]
  double speed = 0;    ///< [m/s]; of what is fixed: at least, while it is carried
  double most = 0;     ///< [m/s^2]
};

/// What bodies are drawn or fixed now; a body that is not named is free. Written by: collision thread (assembly).
struct Attractions {
  double time = 0;                 ///< [s]
  std::vector<Attraction> bodies;  ///< those it is about: more and fewer of them, in room made at load

  Attractions() = default;
  Attractions(const Attractions& other) { *this = other; }
  /// The room comes along, so that a copy has place for whatever the original comes to hold.
  Attractions& operator=(const Attractions& other) {
    bodies.reserve(other.bodies.capacity());
    bodies = other.bodies;
    time = other.time;
    return *this;
  }

  /// Memory beside the struct itself (SizedAtLoad).
  std::size_t roomBytes() const noexcept { return bodies.capacity() * sizeof(Attraction); }
};

}  // namespace presa
