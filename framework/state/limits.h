#pragma once
#include <cstdint>

/// Fixed capacities of everything that crosses threads. Exceeding one is refused at load
/// (fingers, bodies) or counted and reported while running (patch triangles).
namespace presa {

inline constexpr int kMaxFingers = 8;            ///< contact points of one run
inline constexpr int kMaxBodies = 256;           ///< bodies of one scene
inline constexpr int kMaxNearBodies = 4;         ///< mesh bodies one finger can be near at once
inline constexpr int kMaxPatchTriangles = 1024;  ///< triangles of one finger's patch, all bodies together

inline constexpr std::int32_t kNoBody = -1;

}  // namespace presa
