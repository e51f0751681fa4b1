#pragma once
#include <algorithm>
#include <array>
#include <cstdint>

#include "framework/math/spatial.h"
#include "framework/state/limits.h"

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
  double time = 0;  ///< [s]
  std::int32_t count = 0;
  std::array<Attraction, kMaxBodies> bodies;

  Attractions() = default;
  Attractions(const Attractions& other) { *this = other; }
  /// Copies only those in use.
  Attractions& operator=(const Attractions& other) {
    if (this == &other) return *this;
    time = other.time;
    count = other.count;
    std::copy_n(other.bodies.begin(), other.count, bodies.begin());
    return *this;
  }
};

}  // namespace presa
