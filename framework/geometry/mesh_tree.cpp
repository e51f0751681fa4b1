#include "framework/geometry/mesh_tree.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace presa {
namespace {

using Node = MeshTree::Node;
using Facet = MeshTree::Facet;

constexpr double kRounding = 1e-12;  ///< of lengths within a node [-]; the rest is rounded up to single precision
/// Discs of larger nodes are made from those of their children: looser, and a pass over all vertices per level is spared.
constexpr std::int32_t kExactDiscs = 256;

struct Center {
  std::array<float, 3> at;
  std::int32_t id;
};

std::array<float, 3> toFloats(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}
/// What a query will read. GCC 12 vectorises double -> float -> double into nothing, and the disc would be fitted around a
/// centre that was never rounded.
std::array<float, 3> stored(const std::array<float, 3>& v) {
  const volatile float x = v[0], y = v[1], z = v[2];
  return {x, y, z};
}
float roundUp(double value) {
  return std::nextafter(static_cast<float>(value), std::numeric_limits<float>::infinity());
}

/// Splits at the median of the centres along the longest axis: the same tree with every standard library, since ids decide ties.
class Builder {
 public:
  Builder(const TriMesh& mesh, std::vector<Node>& nodes, std::vector<Facet>& facets)
      : mesh_(mesh), nodes_(nodes), facets_(facets) {}

  void build() {
    const std::size_t count = mesh_.triangles.size();
    centers_.resize(count);
    for (std::size_t t = 0; t < count; ++t) {
      centers_[t] = {toFloats((vertex(t, 0) + vertex(t, 1) + vertex(t, 2)) / 3), static_cast<std::int32_t>(t)};
    }
    nodes_.reserve(2 * (2 * count / MeshTree::kLeafTriangles + 1));
    facets_.resize(count);
    nodes_.emplace_back();
    split(MeshTree::kRoot, 0, static_cast<std::int32_t>(count));
    nodes_.shrink_to_fit();
  }

 private:
  const Vec3& vertex(std::size_t triangle, std::size_t i) const {
    return mesh_.vertices[static_cast<std::size_t>(mesh_.triangles[triangle][i])];
  }

  /// Makes the node over centers_[begin, end); returns the sum of its triangles' area vectors.
  Vec3 split(std::int32_t index, std::int32_t begin, std::int32_t end) {
    const auto at = static_cast<std::size_t>(index);
    Vec3 area = Vec3::Zero();
    if (end - begin <= MeshTree::kLeafTriangles) {
      area = makeLeaf(at, begin, end);
    } else {
      const std::int32_t middle = begin + (end - begin) / 2;
      partition(begin, middle, end);
      const auto left = static_cast<std::int32_t>(nodes_.size());
      nodes_.resize(nodes_.size() + 2);
      nodes_[at].first = left;
      area = split(left, begin, middle);
      area += split(left + 1, middle, end);
    }
    const double size = area.norm();
    nodes_[at].axis = stored(toFloats(size > 0 ? Vec3(area / size) : Vec3::UnitZ()));
    if (nodes_[at].isLeaf() || end - begin <= kExactDiscs) {
      fitDisc(nodes_[at], begin, end);
    } else {
      joinDiscs(nodes_[at]);
    }
    return area;
  }

  void partition(std::int32_t begin, std::int32_t middle, std::int32_t end) {
    std::array<float, 3> low = centers_[static_cast<std::size_t>(begin)].at, high = low;
    for (std::int32_t i = begin; i < end; ++i) {
      for (std::size_t a = 0; a < 3; ++a) {
        const float x = centers_[static_cast<std::size_t>(i)].at[a];
        low[a] = std::min(low[a], x);
        high[a] = std::max(high[a], x);
      }
    }
    std::size_t axis = 0;
    for (std::size_t a = 1; a < 3; ++a) {
      if (high[a] - low[a] > high[axis] - low[axis]) axis = a;
    }
    std::nth_element(centers_.begin() + begin, centers_.begin() + middle, centers_.begin() + end,
                     [axis](const Center& l, const Center& r) {
                       return l.at[axis] != r.at[axis] ? l.at[axis] < r.at[axis] : l.id < r.id;
                     });
  }

  Vec3 makeLeaf(std::size_t at, std::int32_t begin, std::int32_t end) {
    nodes_[at].first = begin;
    nodes_[at].count = end - begin;
    std::sort(centers_.begin() + begin, centers_.begin() + end,
              [](const Center& l, const Center& r) { return l.id < r.id; });
    Vec3 area = Vec3::Zero();
    for (std::int32_t i = begin; i < end; ++i) {
      const std::int32_t id = centers_[static_cast<std::size_t>(i)].id;
      const auto t = static_cast<std::size_t>(id);
      facets_[static_cast<std::size_t>(i)] = {mesh_.triangles[t], id};
      area += (vertex(t, 1) - vertex(t, 0)).cross(vertex(t, 2) - vertex(t, 0));
    }
    return area;
  }

  // Around the vertices, as they lie against the rounded axis and centre.
  void fitDisc(Node& node, std::int32_t begin, std::int32_t end) const {
    const Vec3 axis = MeshTree::axisOf(node);
    AxisBox box;
    double low = 1e300, high = -1e300;
    forEachVertex(begin, end, [&](const Vec3& v) {
      box.low = box.low.cwiseMin(v);
      box.high = box.high.cwiseMax(v);
      low = std::min(low, axis.dot(v));
      high = std::max(high, axis.dot(v));
    });
    const Vec3 middle = 0.5 * (box.low + box.high);
    node.center = stored(toFloats(middle + (0.5 * (low + high) - axis.dot(middle)) * axis));
    const Vec3 center = MeshTree::centerOf(node);
    double half = 0, squared = 0;
    forEachVertex(begin, end, [&](const Vec3& v) {
      const Vec3 from = v - center;
      const double z = axis.dot(from);
      half = std::max(half, std::abs(z));
      squared = std::max(squared, (from - z * axis).squaredNorm());
    });
    setSize(node, std::sqrt(squared), half);
  }

  void joinDiscs(Node& node) const {
    const Vec3 axis = MeshTree::axisOf(node);
    const Node& left = nodes_[static_cast<std::size_t>(node.first)];
    const Node& right = nodes_[static_cast<std::size_t>(node.first) + 1];
    node.center = stored(toFloats(0.5 * (MeshTree::centerOf(left) + MeshTree::centerOf(right))));
    const Vec3 center = MeshTree::centerOf(node);
    double radius = 0, half = 0;
    for (const Node* child : {&left, &right}) {
      const Vec3 from = MeshTree::centerOf(*child) - center, other = MeshTree::axisOf(*child);
      const double along = std::min(1.0, std::abs(axis.dot(other))), across = std::min(1.0, axis.cross(other).norm());
      const double z = axis.dot(from);
      half = std::max(half, std::abs(z) + along * child->half + across * child->radius);
      radius = std::max(radius, (from - z * axis).norm() + child->radius + across * child->half);
    }
    setSize(node, radius, half);
  }

  static void setSize(Node& node, double radius, double half) {
    const double slack = kRounding * (radius + half);
    node.radius = roundUp(radius + slack);
    node.half = roundUp(half + slack);
  }

  template <class Visit>
  void forEachVertex(std::int32_t begin, std::int32_t end, const Visit& visit) const {
    for (std::int32_t i = begin; i < end; ++i) {
      const Facet& facet = facets_[static_cast<std::size_t>(i)];
      for (const std::int32_t v : facet.corners) visit(mesh_.vertices[static_cast<std::size_t>(v)]);
    }
  }

  const TriMesh& mesh_;
  std::vector<Node>& nodes_;
  std::vector<Facet>& facets_;
  std::vector<Center> centers_;
};

}  // namespace

MeshTree::MeshTree(std::shared_ptr<const TriMesh> mesh) : mesh_(std::move(mesh)) {
  if (!mesh_ || mesh_->triangles.empty()) throw std::invalid_argument("an empty mesh has no hierarchy");
  const auto finite = [](const Vec3& vertex) { return vertex.allFinite(); };
  if (!std::ranges::all_of(mesh_->vertices, finite))
    throw std::invalid_argument("the mesh has a vertex that is not finite");
  Builder(*mesh_, nodes_, facets_).build();
  const AxisBox box = boundsOf(*mesh_);
  sphere_center_ = 0.5 * (box.low + box.high);
  for (const Vec3& vertex : mesh_->vertices)
    sphere_radius_ = std::max(sphere_radius_, (vertex - sphere_center_).norm());
}

std::size_t MeshTree::cut(const Vec3& center, double radius, std::span<std::int32_t> out) const noexcept {
  if (out.empty()) return 0;
  std::size_t count = 1;
  out[0] = kRoot;
  while (true) {
    std::size_t largest = count;
    for (std::size_t i = 0; i < count; ++i) {
      const Node& n = node(out[i]);
      if (n.isLeaf()) continue;
      if (largest == count || n.radius > node(out[largest]).radius) largest = i;
    }
    if (largest == count) return count;
    const std::int32_t left = node(out[largest]).first;
    double to_left = 0, to_right = 0;
    bound(left, center, to_left);
    bound(left + 1, center, to_right);
    const bool keep_left = to_left <= radius, keep_right = to_right <= radius;
    if (keep_left && keep_right && count == out.size()) return count;
    if (keep_left && keep_right) {
      out[largest] = left;
      out[count++] = left + 1;
    } else if (keep_left || keep_right) {
      out[largest] = keep_left ? left : left + 1;
    } else {
      out[largest] = out[--count];
      if (count == 0) return 0;
    }
  }
}

}  // namespace presa
