#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "framework/core/math/spatial.h"

namespace presa {

/// Where a tool is and how its renderer fared, for pictures, recordings and reports.
struct ToolState {
  bool alive = false;         ///< the device gave a usable sample
  bool lies = false;          ///< it was put down: no force, and it stays at X_WT
  Pose X_WT;                  ///< tool, held off the bodies
  Pose X_HT;                  ///< where the hand grips it; the identity until it was put down and picked up again
  std::uint32_t points = 0;   ///< places in contact in this tick
  std::uint32_t coarse = 0;   ///< since the start: ticks that examined the surface more coarsely than it is given
  std::uint32_t late = 0;     ///< since the start: ticks at whose end tool and forces were not in balance yet
  double depth = 0;           ///< deepest place in this tick [m]
  Vec3 f_H_W = Vec3::Zero();  ///< on the handle, by the inertia of a tool with mass [N]
  Vec3 t_H_W = Vec3::Zero();  ///< the same about H [N m]
};

/// States of all tools, in the order of the scene's roles; fingertips have one that is not alive. Written by: haptic
/// thread. Exists only in runs with tools.
struct ToolStates {
  std::vector<ToolState> tools;                                                            ///< as Scene::devices
  std::size_t roomBytes() const noexcept { return tools.capacity() * sizeof(ToolState); }  ///< SizedAtLoad
};
inline constexpr const char* kToolStatesPort = "tool_states";  ///< port of ToolStates

}  // namespace presa
