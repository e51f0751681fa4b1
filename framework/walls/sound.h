#pragma once
#include <cmath>

#include "framework/bus/wall_link.h"

/// Whether what another process says about a CAVE can be used: it may be damaged or forged.
namespace presa::walls {

/// A head somewhere, with a unit quaternion.
inline bool isSound(const Pose& X_KHead) {
  constexpr double kRounding = 1e-6;  // of a unit quaternion
  return X_KHead.p.allFinite() && std::abs(X_KHead.q.norm() - 1) < kRounding;
}

inline bool isSound(const bus::WallFrame& frame) {
  return frame.leader != 0 && frame.number != 0 && std::isfinite(frame.time) && isSound(frame.X_KHead);
}

inline bool isSound(const bus::WallDrawn& drawn) {
  return drawn.sender != 0 && std::isfinite(drawn.time) && isSound(drawn.X_KHead);
}

}  // namespace presa::walls
