#include "framework/geometry/weld.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace presa {
namespace {

using GridCell = std::array<std::int64_t, 3>;

/// Hash grid over the vertices kept so far. Cells are as wide as the tolerance, so all candidates lie in 27 cells. Hash
/// collisions cost only time, because the distance decides.
class VertexGrid {
 public:
  VertexGrid(const AxisBox& box, double cell_size, std::size_t vertices)
      : origin_(box.low), cell_size_(cell_size), mask_(std::bit_ceil(2 * vertices + 1) - 1), head_(mask_ + 1, kEnd) {}

  /// First kept vertex within `tolerance` of `point`, or -1.
  std::int32_t find(const Vec3& point, const std::vector<Vec3>& kept, double tolerance) const {
    const GridCell center = cellOf(point);
    std::int32_t first = kEnd;
    for (std::int64_t x = -1; x <= 1; ++x) {
      for (std::int64_t y = -1; y <= 1; ++y) {
        for (std::int64_t z = -1; z <= 1; ++z) {
          const std::size_t bucket = hash({center[0] + x, center[1] + y, center[2] + z});
          for (std::int32_t i = head_[bucket]; i != kEnd; i = next_[static_cast<std::size_t>(i)]) {
            const bool near = (kept[static_cast<std::size_t>(i)] - point).norm() <= tolerance;
            if (near && (first == kEnd || i < first)) first = i;
          }
        }
      }
    }
    return first;
  }

  /// Indices are assigned in order of addition: 0, 1, 2 ...
  void add(const Vec3& point) {
    const std::size_t bucket = hash(cellOf(point));
    next_.push_back(head_[bucket]);
    head_[bucket] = static_cast<std::int32_t>(next_.size() - 1);
  }

 private:
  static constexpr std::int32_t kEnd = -1;

  GridCell cellOf(const Vec3& point) const {
    GridCell cell{};
    for (int i = 0; i < 3; ++i) {
      // not finite, or too large for an integer: any cell will do, because such a vertex has no neighbours
      const double index = std::floor((point[i] - origin_[i]) / cell_size_);
      cell[static_cast<std::size_t>(i)] = std::abs(index) < 1e18 ? static_cast<std::int64_t>(index) : 0;
    }
    return cell;
  }
  std::size_t hash(const GridCell& cell) const {
    std::uint64_t h = 0;
    for (const std::int64_t index : cell) {
      h = (h ^ static_cast<std::uint64_t>(index)) * 0x9e3779b97f4a7c15u;
      h ^= h >> 29;
    }
    return static_cast<std::size_t>(h) & mask_;
  }

  Vec3 origin_;
  double cell_size_;
  std::size_t mask_;
  std::vector<std::int32_t> head_;
  std::vector<std::int32_t> next_;
};

bool collapsed(const TriMesh::Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

void renumber(TriMesh& mesh, const std::vector<std::int32_t>& new_index) {
  for (TriMesh::Triangle& triangle : mesh.triangles) {
    for (std::int32_t& index : triangle) index = new_index[static_cast<std::size_t>(index)];
  }
  mesh.adjacency.clear();
}

}  // namespace

std::size_t weld(TriMesh& mesh, double tolerance) { return weld(mesh, tolerance, nullptr); }

std::size_t weld(TriMesh& mesh, double tolerance, std::vector<std::int32_t>* kept_triangles) {
  if (kept_triangles != nullptr) kept_triangles->clear();
  if (mesh.vertices.empty()) return 0;
  const AxisBox box = boundsOf(mesh);
  // lower limit of the cell size, so that the grid index of an ordinary mesh cannot overflow (tolerance 0: equal
  // vertices)
  const double smallest = std::max((box.high - box.low).maxCoeff() * 1e-9, 1e-300);
  VertexGrid grid(box, std::max(tolerance, smallest), mesh.vertices.size());
  std::vector<Vec3> kept;
  std::vector<std::int32_t> new_index;
  new_index.reserve(mesh.vertices.size());
  for (const Vec3& vertex : mesh.vertices) {
    std::int32_t index = grid.find(vertex, kept, tolerance);
    if (index < 0) {
      index = static_cast<std::int32_t>(kept.size());
      kept.push_back(vertex);
      grid.add(vertex);
    }
    new_index.push_back(index);
  }
  const std::size_t removed = mesh.vertices.size() - kept.size();
  renumber(mesh, new_index);
  std::size_t remaining = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (collapsed(mesh.triangles[t])) continue;
    if (kept_triangles != nullptr) kept_triangles->push_back(static_cast<std::int32_t>(t));
    mesh.triangles[remaining++] = mesh.triangles[t];
  }
  mesh.triangles.resize(remaining);
  mesh.vertices = std::move(kept);
  return removed;
}

std::size_t dropUnused(TriMesh& mesh) {
  std::vector<std::int32_t> new_index(mesh.vertices.size(), -1);
  for (const TriMesh::Triangle& triangle : mesh.triangles) {
    for (const std::int32_t index : triangle) new_index[static_cast<std::size_t>(index)] = 0;
  }
  std::size_t used = 0;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (new_index[i] < 0) continue;
    new_index[i] = static_cast<std::int32_t>(used);
    mesh.vertices[used++] = mesh.vertices[i];
  }
  const std::size_t removed = mesh.vertices.size() - used;
  mesh.vertices.resize(used);
  renumber(mesh, new_index);
  return removed;
}

}  // namespace presa
