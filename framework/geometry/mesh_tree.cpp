#include "framework/geometry/mesh_tree.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace presa {
namespace {

using Node = MeshTree::Node;
using Facet = MeshTree::Facet;

constexpr double kRounding = 1e-12;  ///< margin for rounding in double precision, relative to the size of a node [-]
/// A node with more triangles gets its box from its children's boxes: looser, but saves a pass over all vertices per
/// level.
constexpr std::int32_t kExactBoxes = 256;

struct Center {
  std::array<float, 3> at;
  std::int32_t id;
};

std::array<float, 3> toFloats(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}
/// The values as a query will read them. Without volatile, GCC 12 optimises double -> float -> double away when it
/// vectorises, and the box would be fitted around a centre that was never rounded.
std::array<float, 3> stored(const std::array<float, 3>& v) {
  const volatile float x = v[0], y = v[1], z = v[2];
  return {x, y, z};
}
float roundUp(double value) {
  return std::nextafter(static_cast<float>(value), std::numeric_limits<float>::infinity());
}

/// Splits at the median of the centroids along the longest axis. Ids break ties: the same tree with every standard
/// library.
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

  /// Makes the node over centers_[begin, end); returns the sum of the area vectors of its triangles (twice the area).
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
    const Vec3 normal = size > 0 ? Vec3(area / size) : Vec3(Vec3::UnitZ());
    nodes_[at].normal = stored(toFloats(normal));
    if (nodes_[at].isLeaf() || end - begin <= kExactBoxes) {
      fitBox(nodes_[at], normal, begin, end);
    } else {
      joinBoxes(nodes_[at], normal);
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

  /// Sets the long axis of a box: `along` projected into the plane orthogonal to the normal.
  static void setAlong(Node& node, const Vec3& normal, const Vec3& along) {
    const Vec3 flat = along - normal.dot(along) * normal;
    const double length = flat.norm();
    node.along = stored(toFloats(length > 1e-6 * along.norm() ? Vec3(flat / length) : normal.unitOrthogonal()));
  }

  // Leaf: direction of the longest edge, which suits slivers. Inner node: principal axis of the vertices in the plane.
  Vec3 longAxis(const Node& node, const Vec3& normal, std::int32_t begin, std::int32_t end) const {
    Vec3 longest = Vec3::Zero();
    if (node.isLeaf()) {
      for (std::int32_t i = begin; i < end; ++i) {
        const TriMesh::Triangle& corners = facets_[static_cast<std::size_t>(i)].corners;
        for (std::size_t k = 0; k < 3; ++k) {
          const Vec3 edge = mesh_.vertices[static_cast<std::size_t>(corners[(k + 1) % 3])] -
                            mesh_.vertices[static_cast<std::size_t>(corners[k])];
          if (edge.squaredNorm() > longest.squaredNorm()) longest = edge;
        }
      }
      return longest;
    }
    const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
    double count = 0, sum_u = 0, sum_v = 0, uu = 0, vv = 0, uv = 0;
    const Vec3 origin = mesh_.vertices[static_cast<std::size_t>(facets_[static_cast<std::size_t>(begin)].corners[0])];
    forEachVertex(begin, end, [&](const Vec3& vertex) {
      const double x = u.dot(vertex - origin), y = v.dot(vertex - origin);
      count += 1, sum_u += x, sum_v += y, uu += x * x, vv += y * y, uv += x * y;
    });
    const double spread_u = uu - sum_u * sum_u / count, spread_v = vv - sum_v * sum_v / count;
    const double angle = 0.5 * std::atan2(2 * (uv - sum_u * sum_v / count), spread_u - spread_v);
    return std::cos(angle) * u + std::sin(angle) * v;
  }

  // Fits the box around the vertices with the axes and the centre as rounded to single precision.
  void fitBox(Node& node, const Vec3& normal, std::int32_t begin, std::int32_t end) const {
    setAlong(node, normal, longAxis(node, normal, begin, end));
    const Mat3 to_box = MeshTree::axesOf(node).transpose();
    AxisBox box;
    forEachVertex(begin, end, [&](const Vec3& vertex) {
      const Vec3 at = to_box * vertex;
      box.low = box.low.cwiseMin(at);
      box.high = box.high.cwiseMax(at);
    });
    node.center = stored(toFloats(to_box.transpose() * (0.5 * (box.low + box.high))));
    const Vec3 center = MeshTree::centerOf(node);
    Vec3 half = Vec3::Zero();
    forEachVertex(begin, end,
                  [&](const Vec3& vertex) { half = half.cwiseMax((to_box * (vertex - center)).cwiseAbs()); });
    setHalf(node, half);
  }

  void joinBoxes(Node& node, const Vec3& normal) const {
    const Node& left = nodes_[static_cast<std::size_t>(node.first)];
    const Node& right = nodes_[static_cast<std::size_t>(node.first) + 1];
    setAlong(node, normal, MeshTree::centerOf(right) - MeshTree::centerOf(left));
    const Mat3 to_box = MeshTree::axesOf(node).transpose();
    AxisBox box;
    forEachChild(left, right, to_box, Vec3::Zero(), [&](const Vec3& at, const Vec3& half) {
      box.low = box.low.cwiseMin(at - half);
      box.high = box.high.cwiseMax(at + half);
    });
    node.center = stored(toFloats(to_box.transpose() * (0.5 * (box.low + box.high))));
    Vec3 sum = Vec3::Zero();
    forEachChild(left, right, to_box, MeshTree::centerOf(node),
                 [&](const Vec3& at, const Vec3& half) { sum = sum.cwiseMax(at.cwiseAbs() + half); });
    setHalf(node, sum);
  }

  /// Calls visit(centre, half extents) for the boxes of both children, expressed in the axes `to_box`, relative to
  /// `origin`.
  template <class Visit>
  static void forEachChild(const Node& left, const Node& right, const Mat3& to_box, const Vec3& origin,
                           const Visit& visit) {
    for (const Node* child : {&left, &right}) {
      const Mat3 turned = to_box * MeshTree::axesOf(*child);
      const Vec3 half(child->half[0], child->half[1], child->half[2]);
      visit(Vec3(to_box * (MeshTree::centerOf(*child) - origin)), Vec3(turned.cwiseAbs() * half));
    }
  }

  static void setHalf(Node& node, const Vec3& half) {
    for (std::size_t i = 0; i < 3; ++i) {
      node.half[i] = roundUp(half[static_cast<Eigen::Index>(i)] + kRounding * half.sum());
    }
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
  std::vector<std::int32_t> place(mesh_->vertices.size(), -1);
  vertices_.reserve(mesh_->vertices.size());
  for (Facet& facet : facets_) {
    for (std::int32_t& corner : facet.corners) {
      std::int32_t& at = place[static_cast<std::size_t>(corner)];
      if (at < 0) {
        at = static_cast<std::int32_t>(vertices_.size());
        vertices_.push_back(mesh_->vertices[static_cast<std::size_t>(corner)]);
      }
      corner = at;
    }
  }
  const AxisBox box = boundsOf(*mesh_);
  sphere_center_ = 0.5 * (box.low + box.high);
  for (const Vec3& vertex : mesh_->vertices)
    sphere_radius_ = std::max(sphere_radius_, (vertex - sphere_center_).norm());
}

std::size_t MeshTree::cut(const Vec3& center, double radius, std::span<std::int32_t> out) const noexcept {
  const auto within = [&](std::int32_t node) {
    double distance = 0;
    bound(node, center, distance);
    return distance <= radius;
  };
  return cutWhere(within, out);
}

}  // namespace presa
