#pragma once
#include <string>
#include <vector>

#include "framework/scene/scene.h"

namespace presa {

/// One number of a material that commands may set while a run goes on, and its range.
struct OpenSurface {
  std::size_t material = 0;           ///< index into Scene::materials
  double Material::*value = nullptr;  ///< which of its numbers
  std::string name;                   ///< as a path of --set: material/steel/stiffness
  double least = 0, most = 0;         ///< both included
};

/// Of every material that fingers can touch, in the order of the scene:
/// - stiffness from 1 N/m to what the scene loaded with. That has passed the bound of stability, and less is as stable; more is not.
/// - friction up to twice what the scene loaded with. A cone takes energy whatever its width, and the spring within it has the same
///   stiffness; twice is as far as a surface may become another. A material without friction stays without, and friction that an
///   experiment changes (<changed>) is not for others.
/// The first SurfaceSettings::kMost at most.
std::vector<OpenSurface> openSurfaces(const Scene& scene);

}  // namespace presa
