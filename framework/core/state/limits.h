#pragma once
#include <cstdint>

/// Fixed capacities of what crosses threads. Exceeding one is refused at load (fingers) or handled and counted while
/// running (bodies near one finger). What there is one of for each body is sized at load by the scene instead.
namespace presa {

inline constexpr int kMaxFingers = 8;       ///< contact points of one run
inline constexpr int kMaxBodies = 100'000;  ///< bodies of one scene: a bound on slips, nothing has this size
inline constexpr int kMaxNearBodies = 64;   ///< bodies that the collision thread lists for one finger
inline constexpr int kMaxCutNodes = 16;     ///< nodes of a mesh's hierarchy that it hands over for one finger and body

inline constexpr std::int32_t kNoBody = -1;

}  // namespace presa
