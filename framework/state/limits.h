#pragma once
#include <cstdint>

/// Fixed capacities of everything that crosses threads. Exceeding one is refused at load
/// (fingers, bodies) or counted and reported while running (bodies near one finger).
namespace presa {

inline constexpr int kMaxFingers = 8;      ///< contact points of one run
inline constexpr int kMaxBodies = 256;     ///< bodies of one scene
inline constexpr int kMaxNearBodies = 64;  ///< bodies that the collision thread lists for one finger
inline constexpr int kMaxCutNodes = 16;    ///< nodes of a mesh's hierarchy that it hands over for one finger and body

inline constexpr std::int32_t kNoBody = -1;

}  // namespace presa
