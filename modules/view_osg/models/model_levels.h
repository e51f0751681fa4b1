#pragma once
#include "modules/view_osg/models/model_surface.h"

namespace presa::view {

/// The triangles of a model at one level of detail, over the vertices of its surface.
struct ModelLevel {
  std::vector<std::vector<std::uint32_t>> corners;  ///< by part
  std::size_t triangles = 0;
  double error = 0;  ///< about how far the surface is from the finest [m]
};

/// The finest level first; each further one has about a quarter of the triangles. Texture seams and edges between parts
/// stay closed. Where vertices have colours, a place whose colour differs from its neighbours counts as a bump, so that it
/// is kept.
std::vector<ModelLevel> levelsOf(const ModelSurface& surface);

}  // namespace presa::view
