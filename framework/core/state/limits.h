#pragma once
#include <cstdint>

/// Fixed capacities of the data that crosses threads. Too many bodies near one finger are handled and counted while
/// running. Data per finger and per body has no fixed capacity: the scene sizes it at load.
namespace presa {

inline constexpr int kMaxFingers = 1'000;   ///< devices of one scene: catches typing errors, no array has this size
inline constexpr int kMaxBodies = 100'000;  ///< bodies of one scene: the same
inline constexpr int kMaxNearBodies = 64;   ///< bodies that the collision thread lists for one finger
inline constexpr int kMaxCutNodes = 16;     ///< nodes of a MeshTree that it hands over for one finger and body

inline constexpr std::int32_t kNoBody = -1;  ///< an index of a body that means none: free space, the world

}  // namespace presa
