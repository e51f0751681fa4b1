#pragma once
#include <memory>
#include <span>
#include <vector>

#include "modules/collision_fcl/facet_set.h"
#include "modules/collision_fcl/probe_way.h"

namespace presa {

/// FCL's tree of oriented boxes over some facets of a mesh: each box along the principal axes of its triangles, split
/// at the mean along its longest side, one triangle in a leaf [Gottschalk1996]. Frame: mesh coordinates [m]. Thread:
/// any; allocates at construction only.
class ObbTree {
 public:
  /// `facets`: at least one. The mesh must outlive the tree.
  ObbTree(const MeshTree& mesh, std::span<const std::int32_t> facets);
  ~ObbTree();
  ObbTree(ObbTree&&) noexcept;

  /// Adds to `found` those of its facets that the way reaches.
  void find(const ProbeWay& way, FacetSet& found) const noexcept;

 private:
  struct Model;
  void search(int node, const ProbeWay& way, bool inside, FacetSet& found) const noexcept;

  const MeshTree* mesh_;
  std::vector<std::int32_t> facets_;  // by FCL's index of a triangle
  std::unique_ptr<Model> model_;
};

}  // namespace presa
