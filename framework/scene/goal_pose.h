#pragma once
#include <cstddef>

#include "framework/core/math/spatial.h"

namespace presa {

/// Distance between two poses of a body: translation and rotation angle.
struct PoseDifference {
  double distance = 0;  ///< [m]
  double angle = 0;     ///< [rad], 0 to pi
};
/// How far `b` is from `a`; symmetric.
PoseDifference poseDifference(const Pose& a, const Pose& b);

/// The goal pose nearest to the orientation `q_WB`, among the poses that look the same as `X_WB`: turned about the
/// body's own z axis by multiples of 2 pi / fold, or by any angle when `fold` is 0. The position is that of `X_WB`.
Pose nearestTurn(const Pose& X_WB, std::size_t fold, const Quat& q_WB);

}  // namespace presa
