#pragma once
#include <memory>
#include <span>

#include "framework/scene/scene.h"
#include "modules/collision_fcl/facet_set.h"
#include "modules/collision_fcl/probe_way.h"

namespace presa {

/// Finds the triangles of one mesh that a probe can reach on its way. Frame: mesh coordinates [m]. Thread: one;
/// allocates at construction only.
class MeshIndex {
 public:
  MeshIndex() = default;
  virtual ~MeshIndex() = default;
  MeshIndex(const MeshIndex&) = delete;
  MeshIndex& operator=(const MeshIndex&) = delete;

  /// Adds to `found` the facets within way.radius of the way: all of them, and no others.
  virtual void find(const ProbeWay& way, FacetSet& found) noexcept = 0;
};

/// The chosen index over a mesh, which must outlive it.
std::unique_ptr<MeshIndex> makeMeshIndex(CollisionSettings::Index kind, const MeshTree& mesh);

/// A cut through the mesh's hierarchy that holds every found facet (MeshTree::cut). Returns the number of its nodes; 0
/// when nothing was found.
std::size_t cutAround(const FacetSet& found, const MeshTree& mesh, std::span<std::int32_t> out) noexcept;

}  // namespace presa
