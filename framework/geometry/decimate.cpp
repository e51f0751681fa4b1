#include "framework/geometry/decimate.h"

#include <algorithm>

#include "framework/geometry/closest_point.h"
#include "framework/geometry/mesh_decimate_abi.h"
#include "framework/plugin/plugin_loader.h"

namespace presa {
namespace {

/// Hierarchy of axis-aligned boxes over the triangles of a mesh: nearest distance in logarithmic time.
class DistanceTree {
 public:
  explicit DistanceTree(const TriMesh& mesh) : mesh_(mesh), order_(mesh.triangles.size()) {
    for (std::size_t i = 0; i < order_.size(); ++i) order_[i] = i;
    nodes_.reserve(2 * order_.size());
    build(0, order_.size());
  }

  /// Squared distance of p from the mesh [m^2], or `bound` when it is larger.
  double squaredDistance(const Vec3& p, double bound) const { return search(0, p, bound); }

 private:
  static constexpr std::size_t kLeaf = 4;
  struct Node {
    AxisBox box;
    std::size_t begin = 0, end = 0, right = 0;  // right 0: a leaf
  };

  const Vec3& corner(std::size_t triangle, std::size_t i) const {
    return mesh_.vertices[static_cast<std::size_t>(mesh_.triangles[triangle][i])];
  }

  std::size_t build(std::size_t begin, std::size_t end) {
    const std::size_t index = nodes_.size();
    Node node{{}, begin, end, 0};
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        node.box.low = node.box.low.cwiseMin(corner(order_[i], c));
        node.box.high = node.box.high.cwiseMax(corner(order_[i], c));
      }
    }
    nodes_.push_back(node);
    if (end - begin <= kLeaf) return index;
    Eigen::Index axis = 0;
    (node.box.high - node.box.low).maxCoeff(&axis);
    const std::size_t middle = (begin + end) / 2;
    const auto at = [this](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    const auto centre = [&](std::size_t t) { return corner(t, 0)[axis] + corner(t, 1)[axis] + corner(t, 2)[axis]; };
    std::nth_element(at(begin), at(middle), at(end),
                     [&](std::size_t a, std::size_t b) { return centre(a) < centre(b); });
    build(begin, middle);
    nodes_[index].right = build(middle, end);
    return index;
  }

  static double squaredTo(const AxisBox& box, const Vec3& p) {
    return (p - p.cwiseMax(box.low).cwiseMin(box.high)).squaredNorm();
  }

  double search(std::size_t index, const Vec3& p, double best) const {
    const Node& node = nodes_[index];
    if (node.right == 0) {
      for (std::size_t i = node.begin; i < node.end; ++i) {
        const std::size_t t = order_[i];
        best = std::min(best, (p - closestOnTriangle(p, corner(t, 0), corner(t, 1), corner(t, 2))).squaredNorm());
      }
      return best;
    }
    std::size_t near = index + 1, far = node.right;
    double near_distance = squaredTo(nodes_[near].box, p), far_distance = squaredTo(nodes_[far].box, p);
    if (far_distance < near_distance) {
      std::swap(near, far);
      std::swap(near_distance, far_distance);
    }
    if (near_distance < best) best = search(near, p, best);
    if (far_distance < best) best = search(far, p, best);
    return best;
  }

  const TriMesh& mesh_;
  std::vector<std::size_t> order_;
  std::vector<Node> nodes_;
};

double farthest(const TriMesh& from, const TriMesh& to) {
  const DistanceTree tree(to);
  double largest = 0;
  const auto look = [&](const Vec3& p) { largest = std::max(largest, tree.squaredDistance(p, 1e300)); };
  for (const Vec3& vertex : from.vertices) look(vertex);
  for (const TriMesh::Triangle& triangle : from.triangles) {
    const Vec3& a = from.vertices[static_cast<std::size_t>(triangle[0])];
    const Vec3& b = from.vertices[static_cast<std::size_t>(triangle[1])];
    const Vec3& c = from.vertices[static_cast<std::size_t>(triangle[2])];
    look((a + b + c) / 3);
    // visit each edge once: the other triangle of the edge runs through it in the opposite direction
    if (triangle[0] < triangle[1]) look((a + b) / 2);
    if (triangle[1] < triangle[2]) look((b + c) / 2);
    if (triangle[2] < triangle[0]) look((c + a) / 2);
  }
  return std::sqrt(largest);
}

}  // namespace

TriMesh decimateMesh(const TriMesh& mesh, std::size_t triangles) {
  const auto simplify = reinterpret_cast<DecimateMeshFunction>(pluginSymbol("mesh_decimate", kMeshDecimateSymbol));
  std::vector<float> coordinates;
  for (const Vec3& v : mesh.vertices)
    coordinates.insert(coordinates.end(),
                       {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())});
  std::vector<std::uint32_t> indices, out;
  for (const TriMesh::Triangle& t : mesh.triangles) {
    for (const std::int32_t corner : t) indices.push_back(static_cast<std::uint32_t>(corner));
  }
  out.resize(indices.size());
  out.resize(
      simplify(indices.data(), indices.size(), coordinates.data(), mesh.vertices.size(), 3 * triangles, out.data()));
  TriMesh decimated;
  decimated.vertices = mesh.vertices;
  for (std::size_t i = 0; i + 2 < out.size(); i += 3) {
    decimated.triangles.push_back({static_cast<std::int32_t>(out[i]), static_cast<std::int32_t>(out[i + 1]),
                                   static_cast<std::int32_t>(out[i + 2])});
  }
  dropUnused(decimated);
  return decimated;
}

double hausdorffDistance(const TriMesh& a, const TriMesh& b) { return std::max(farthest(a, b), farthest(b, a)); }

}  // namespace presa
