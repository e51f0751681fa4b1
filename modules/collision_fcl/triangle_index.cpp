#include "modules/collision_fcl/triangle_index.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/AABB.h>

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <cmath>
#include <stdexcept>

#include "framework/geometry/closest_point.h"

namespace presa {
namespace {

// Axis-aligned boxes are the fastest to traverse by hand and the smallest: README.md has the figures.
using Box = fcl::AABB<double>;
using Model = fcl::BVHModel<Box>;

/// Boxes are pruned only when they are farther than the search radius by more than rounding [-]: a box distance and
/// the distance of the triangle inside it are computed by different formulas.
constexpr double kPruneSlack = 1 + 1e-12;

/// Pending nodes that fit without allocating [-]: real trees are below 60 deep, a hostile mesh may be deeper.
constexpr std::size_t kUsualDepth = 128;

double squaredDistance(const Box& box, const Vec3& p) {
  return (box.min_ - p).cwiseMax(p - box.max_).cwiseMax(0.0).squaredNorm();
}

void build(Model& model, const TriMesh& mesh) {
  model.beginModel(static_cast<int>(mesh.triangles.size()), static_cast<int>(mesh.vertices.size()));
  std::vector<fcl::Triangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const TriMesh::Triangle& t : mesh.triangles) {
    triangles.emplace_back(static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]),
                           static_cast<std::size_t>(t[2]));
  }
  model.addSubModel(mesh.vertices, triangles);
  const int result = model.endModel();
  const bool finite = model.getNumBVs() > 0 && model.getBV(0).bv.min_.allFinite() && model.getBV(0).bv.max_.allFinite();
  if (result != fcl::BVH_OK || !finite) throw std::invalid_argument("the mesh has no finite bounding-volume hierarchy");
}

}  // namespace

struct TriangleIndex::Tree {
  Model model;
};

TriangleIndex::TriangleIndex(std::shared_ptr<const TriMesh> mesh) : mesh_(std::move(mesh)), tree_(new Tree) {
  if (!mesh_ || mesh_->triangles.empty()) throw std::invalid_argument("an empty mesh cannot be indexed");
  const auto finite = [](const Vec3& vertex) { return vertex.allFinite(); };
  if (!std::ranges::all_of(mesh_->vertices, finite))
    throw std::invalid_argument("the mesh has a vertex that is not finite");
  build(tree_->model, *mesh_);
  const AxisBox box = boundsOf(*mesh_);
  sphere_center_ = 0.5 * (box.low + box.high);
  for (const Vec3& vertex : mesh_->vertices)
    sphere_radius_ = std::max(sphere_radius_, (vertex - sphere_center_).norm());
}

TriangleIndex::~TriangleIndex() = default;
TriangleIndex::TriangleIndex(TriangleIndex&&) noexcept = default;
TriangleIndex& TriangleIndex::operator=(TriangleIndex&&) noexcept = default;

Gathered TriangleIndex::gather(const Vec3& center, double radius, std::size_t capacity,
                               std::vector<NearTriangle>& out) const {
  out.clear();
  Gathered result{radius, false};
  if (capacity == 0 || !(radius >= 0) || !center.allFinite()) return {0, true};
  const Model& model = tree_->model;
  double limit = radius;  // shrinks once the list is full

  const auto distanceTo = [&](std::int32_t id) {
    const TriMesh::Triangle& t = mesh_->triangles[static_cast<std::size_t>(id)];
    const auto at = [&](std::size_t i) -> const Vec3& { return mesh_->vertices[static_cast<std::size_t>(t[i])]; };
    return (center - closestOnTriangle(center, at(0), at(1), at(2))).norm();
  };
  const auto keep = [&](const NearTriangle& candidate) {
    if (out.size() < capacity) {
      out.push_back(candidate);
      std::ranges::push_heap(out, nearer);
    } else {
      result.capped = true;
      if (!nearer(candidate, out.front())) return;
      std::ranges::pop_heap(out, nearer);
      out.back() = candidate;
      std::ranges::push_heap(out, nearer);
    }
    if (out.size() == capacity) limit = std::min(limit, out.front().distance);
  };

  struct Pending {
    int node;
    double squared;
  };
  boost::container::small_vector<Pending, kUsualDepth> stack;
  stack.push_back({0, squaredDistance(model.getBV(0).bv, center)});
  while (!stack.empty()) {
    const Pending pending = stack.back();
    stack.pop_back();
    if (pending.squared > limit * limit * kPruneSlack) {
      // within the radius asked for, but behind a full list: something may be missing there
      result.capped |= pending.squared <= radius * radius * kPruneSlack;
      continue;
    }
    const auto& node = model.getBV(pending.node);
    if (node.isLeaf()) {
      const NearTriangle candidate{distanceTo(node.primitiveId()), node.primitiveId()};
      if (candidate.distance <= radius) keep(candidate);
      continue;
    }
    Pending near{node.leftChild(), squaredDistance(model.getBV(node.leftChild()).bv, center)};
    Pending far{node.rightChild(), squaredDistance(model.getBV(node.rightChild()).bv, center)};
    if (far.squared < near.squared) std::swap(near, far);
    stack.push_back(far);
    stack.push_back(near);
  }
  // Of triangles at the very same distance as the farthest kept one some may be missing: stop just before it.
  if (result.capped) result.radius = std::nextafter(out.front().distance, 0.0);
  return result;
}

}  // namespace presa
