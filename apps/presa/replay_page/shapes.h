#pragma once
#include <nlohmann/json_fwd.hpp>

#include "apps/presa/replay_page/figures.h"
#include "framework/scene/world.h"

namespace presa::replay_page {

inline constexpr std::size_t kMaxTriangles = 20'000;  ///< of all meshes of a page together
inline constexpr std::size_t kMaxBodies = 3000;       ///< that a page draws

/// The drawn shapes: {meshes: […], bodies: [{name, color, mu, pose, shapes}], parts: [{name, shapes}], floor}; parts are
/// those of the devices' figures, each shape with its color. A body without
/// visual geometry is drawn by its haptic, else its physics geometry, as in the window. Meshes are simplified to
/// kMaxTriangles together, each once. `pose` is the start pose (x y z, quaternion w x y z); `floor` the lowest z of the
/// scene [m]. Thread: main. Throws InputError when the plug-in that simplifies meshes is missing.
nlohmann::json shapesOf(const World& world, const PageFigures& figures);

}  // namespace presa::replay_page
