#pragma once
#include "framework/geometry/model.h"

namespace presa::view {

/// A model with all that shading needs.
struct ModelSurface {
  std::vector<ModelVertex> vertices;  ///< all with normals
  std::vector<std::uint32_t> corners;
  std::vector<Model::Part> parts;              ///< ranges of these vertices and corners
  std::vector<std::array<float, 4>> tangents;  ///< along which the map's x grows, and the sign of its y; empty: no use
};

/// Normals of the file; where it has none, those of the faces around a vertex, with edges above `crease_angle` [rad].
/// Tangents are sums over the triangles of a vertex [Lengyel2001].
ModelSurface modelSurface(const Model& model, double crease_angle);

/// Numbers the places of vertices: equal positions have one number.
std::vector<std::uint32_t> placesOf(const std::vector<ModelVertex>& vertices);

}  // namespace presa::view
