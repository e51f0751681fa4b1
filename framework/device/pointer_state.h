#pragma once
#include <cstdint>

#include "framework/core/math/spatial.h"

namespace presa {

/// Port that carries it.
inline constexpr const char* kPointerPort = "pointer_state";

/// Where somebody at the window wants a pair of fingertips, in full at any time: a reader that misses some misses nothing.
/// Written by: view thread.
struct PointerState {
  std::uint64_t sequence = 0;  ///< grows with every change; 0: nobody has asked for anything yet
  Vec3 p_WT = Vec3::Zero();    ///< middle between the fingertips' centres [m]
  double yaw = 0;              ///< of the level line from thumb to index, from +x about +z [rad]; any number of turns
  double closing = 0;          ///< 0: wide open; 1: closed as hard as the pair may
};

}  // namespace presa
