#pragma once
#include <cstddef>

#include "framework/core/math/spatial.h"

namespace presa {

/// How far a body is from where it belongs.
struct Way {
  double distance = 0;  ///< [m]
  double angle = 0;     ///< [rad], 0 to pi
};
Way wayBetween(const Pose& a, const Pose& b);

/// Of all poses in which a body looks the same at `X_WB` — turned about its own z axis by multiples of 1/fold, or by anything
/// when fold is 0 — the one nearest to the orientation `q_WB`.
Pose nearestTurn(const Pose& X_WB, std::size_t fold, const Quat& q_WB);

}  // namespace presa
