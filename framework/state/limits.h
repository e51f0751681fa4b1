#pragma once
#include <cstdint>

/// Fixed capacities of what crosses threads. Exceeding one is refused at load (fingers) or counted and reported while
/// running (patch triangles). What there is one of for each body is sized at load by the scene instead.
namespace presa {

inline constexpr int kMaxFingers = 8;            ///< contact points of one run
inline constexpr int kMaxBodies = 100'000;       ///< bodies of one scene: a bound on slips, nothing has this size
inline constexpr int kMaxNearBodies = 4;         ///< mesh bodies one finger can be near at once
inline constexpr int kMaxPatchTriangles = 1024;  ///< triangles of one finger's patch, all bodies together

inline constexpr std::int32_t kNoBody = -1;

}  // namespace presa
