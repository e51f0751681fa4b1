#pragma once
#include <functional>
#include <string>

#include "framework/plan/load_world.h"

namespace presa::temple {

/// What came of an assembly that two simulated fingers did by themselves.
struct Rebuilt {
  int pieces = 0, placed = 0;
  double worst_position_error = 0;  ///< of the placed, from where they belong [m]
  double worst_angle_error = 0;     ///< [rad]
  int drops = 0;                    ///< times a lifted piece fell
  double mean_fingertip_depth = 0;  ///< of the fingertips into what they touch, while they do [m]
  double simulated_seconds = 0, wall_seconds = 0;
  std::uint32_t faults = 0;  ///< ObjectFault bits
};

/// Called now and then with the pieces that stand; false stops.
using RebuildProgress = std::function<bool(int placed, int pieces)>;

/// Runs a scene with an <assembly> in lockstep until everything stands where it belongs, or `limit` simulated seconds. With a view when
/// the world's options ask for one. Throws InputError. Thread: main.
Rebuilt rebuild(const Loaded& loaded, double limit, const RebuildProgress& progress);

/// As JSON: size seed pieces placed worst_position_error_m worst_angle_error_deg drops mean_fingertip_depth_m simulated_s wall_s faults.
std::string summaryText(const Rebuilt& rebuilt, const std::string& size, std::uint64_t seed);

}  // namespace presa::temple
