#pragma once
#include <cstddef>
#include <vector>

namespace presa {

/// Positions of all joints at one moment, with their turns, which poses alone do not tell: what a recording knows.
struct JointPositions {
  std::vector<double> of;  ///< joint by joint, position by position [m, rad]
  /// Heap memory that it owns [bytes] (SizedAtLoad).
  std::size_t roomBytes() const noexcept { return of.capacity() * sizeof(double); }
};
/// Port of the positions; exists only where a recording with joints is shown.
inline constexpr const char* kJointPositionsPort = "joint_positions";

}  // namespace presa
