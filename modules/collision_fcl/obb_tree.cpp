#include "modules/collision_fcl/obb_tree.h"

#include <fcl/geometry/bvh/BVH_model.h>

#include <stdexcept>
#include <unordered_map>

namespace presa {

struct ObbTree::Model {
  fcl::BVHModel<fcl::OBB<double>> tree;
};

ObbTree::ObbTree(const MeshTree& mesh, std::span<const std::int32_t> facets)
    : mesh_(&mesh), facets_(facets.begin(), facets.end()), model_(std::make_unique<Model>()) {
  std::vector<fcl::Vector3<double>> vertices;
  std::vector<fcl::Triangle> triangles;
  std::unordered_map<std::int32_t, std::size_t> place;  // of a vertex of the mesh
  triangles.reserve(facets_.size());
  for (const std::int32_t f : facets_) {
    const MeshTree::Facet& facet = mesh.facet(f);
    std::array<std::size_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [at, fresh] = place.try_emplace(facet.corners[k], vertices.size());
      if (fresh) vertices.push_back(mesh.corner(facet, k));
      corners[k] = at->second;
    }
    triangles.emplace_back(corners[0], corners[1], corners[2]);
  }
  auto& tree = model_->tree;
  tree.beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size()));
  tree.addSubModel(vertices, triangles);
  if (tree.endModel() != fcl::BVH_OK) throw std::invalid_argument("FCL cannot build a tree over this mesh");
}

ObbTree::~ObbTree() = default;
ObbTree::ObbTree(ObbTree&&) noexcept = default;

void ObbTree::find(const ProbeWay& way, FacetSet& found) const noexcept { search(0, way, false, found); }

void ObbTree::search(int node, const ProbeWay& way, bool inside, FacetSet& found) const noexcept {
  const auto& at = model_->tree.getBV(node);
  if (!inside) {
    if (!way.mayTouch(at.bv.axis, at.bv.To, at.bv.extent)) return;
    inside = way.holds(at.bv.To, at.bv.extent);
  }
  if (at.isLeaf()) {
    const std::int32_t facet = facets_[static_cast<std::size_t>(at.primitiveId())];
    if (inside || (!found.has(facet) && reaches(way, *mesh_, facet))) found.add(facet);
  } else {
    search(at.leftChild(), way, inside, found);
    search(at.rightChild(), way, inside, found);
  }
}

}  // namespace presa
