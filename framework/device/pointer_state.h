#pragma once
#include <cstdint>

#include "framework/core/math/spatial.h"

namespace presa {

/// Name of the port that carries a PointerState.
inline constexpr const char* kPointerPort = "pointer_state";

/// Pose that the user at the window wants for a pair of fingertips, or for a stylus. Each value is complete: a reader may miss some.
/// Written by: view thread.
struct PointerState {
  std::uint64_t sequence = 0;  ///< grows with every change; 0: no input yet
  Vec3 p_WT = Vec3::Zero();    ///< midpoint between the fingertips' centres; tip of a stylus [m]
  double yaw = 0;              ///< angle from +x to the horizontal line thumb to index, about +z [rad]; unbounded;
                               ///< direction in which a stylus leans
  double closing = 0;          ///< 0: wide open; 1: closed as hard as the pair may
  double tilt = 0;             ///< of a stylus, from upright [rad]
  double wheel = 0;  ///< sum of all steps of closing, unbounded: counts them also where `closing` is at its end
};

}  // namespace presa
