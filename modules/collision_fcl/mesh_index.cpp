#include "modules/collision_fcl/mesh_index.h"

#include <numeric>
#include <vector>

#include "modules/collision_fcl/hashed_grid.h"
#include "modules/collision_fcl/obb_tree.h"

namespace presa {
namespace {

/// Presa's own hierarchy, asked for single triangles: what the others are compared with. The collision thread takes its
/// cut without them.
class OwnTree final : public MeshIndex {
 public:
  explicit OwnTree(const MeshTree& mesh) : mesh_(mesh) {}
  void find(const ProbeWay& way, FacetSet& found) noexcept override { search(MeshTree::kRoot, way, found); }

 private:
  void search(std::int32_t index, const ProbeWay& way, FacetSet& found) const noexcept {
    const MeshTree::Node& node = mesh_.node(index);
    const Vec3 half(node.half[0], node.half[1], node.half[2]);
    if (!way.mayTouch(MeshTree::axesOf(node), MeshTree::centerOf(node), half)) return;
    if (!node.isLeaf()) {
      search(node.first, way, found);
      search(node.first + 1, way, found);
    } else {
      const bool all = way.holds(MeshTree::centerOf(node), half);
      for (std::int32_t f = node.first; f < node.first + node.count; ++f) {
        if (all || reaches(way, mesh_, f)) found.add(f);
      }
    }
  }

  const MeshTree& mesh_;
};

class OneObbTree final : public MeshIndex {
 public:
  explicit OneObbTree(const MeshTree& mesh) : tree_(mesh, everyFacet(mesh)) {}
  void find(const ProbeWay& way, FacetSet& found) noexcept override { tree_.find(way, found); }

 private:
  static std::vector<std::int32_t> everyFacet(const MeshTree& mesh) {
    std::vector<std::int32_t> facets(mesh.mesh().triangles.size());
    std::iota(facets.begin(), facets.end(), 0);
    return facets;
  }
  ObbTree tree_;
};

}  // namespace

std::unique_ptr<MeshIndex> makeMeshIndex(CollisionSettings::Index kind, const MeshTree& mesh) {
  switch (kind) {
    case CollisionSettings::Index::kObb:
      return std::make_unique<OneObbTree>(mesh);
    case CollisionSettings::Index::kHcollide:
      return std::make_unique<HashedGrid>(mesh);
    case CollisionSettings::Index::kTree:
      break;
  }
  return std::make_unique<OwnTree>(mesh);
}

std::size_t cutAround(const FacetSet& found, const MeshTree& mesh, std::span<std::int32_t> out) noexcept {
  if (found.all().empty()) return 0;
  const auto keep = [&](std::int32_t node) {
    const MeshTree::Node *first = &mesh.node(node), *last = first;
    while (!first->isLeaf()) first = &mesh.node(first->first);
    while (!last->isLeaf()) last = &mesh.node(last->first + 1);
    return found.hasAny(first->first, last->first + last->count);
  };
  return mesh.cutWhere(keep, out);
}

}  // namespace presa
