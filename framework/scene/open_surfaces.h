#pragma once
#include <string>
#include <vector>

#include "framework/scene/scene.h"

namespace presa {

/// A material parameter that bus commands may change during a run, and its range.
struct OpenSurface {
  std::size_t material = 0;           ///< index into Scene::materials
  double Material::*value = nullptr;  ///< the parameter
  std::string name;                   ///< its path, as for --set: material/steel/stiffness
  double min = 0,                     ///< smallest value that a command may set
      max = 0;                        ///< largest one
};

/// The open parameters of every material that fingers can touch, in the order of the scene:
/// - stiffness from 1 N/m to the loaded value. The loaded value has passed the stability check; a lower one is as
///   stable.
/// - friction up to twice the loaded value. Friction dissipates whatever the width of the cone, and the stiffness
///   within the cone stays the same; the factor two limits how much a surface may change. A material without friction
///   stays without, and friction that an experiment changes (`<changed>`) is closed to commands.
/// At most the first SurfaceSettings::kCapacity parameters.
std::vector<OpenSurface> openSurfaces(const Scene& scene);

}  // namespace presa
