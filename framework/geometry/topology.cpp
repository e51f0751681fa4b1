#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>

#include "framework/geometry/tri_mesh.h"

namespace presa {
namespace {

/// A triangle is degenerate when its height is below this fraction of its longest edge [-]. Coordinates have single
/// precision (6e-8 relative), so the normal of a flatter triangle is only rounding.
constexpr double kFlat = 1e-7;

/// One side of a triangle; sorting brings the half-edges of an edge together.
struct HalfEdge {
  std::int32_t low, high;  // vertices, low < high
  std::int32_t triangle;
  std::int8_t side;  // 0, 1, 2
  bool forward;      // runs from low to high
};

bool validIndices(const TriMesh& mesh, const TriMesh::Triangle& triangle) {
  return std::ranges::all_of(
      triangle, [&](std::int32_t i) { return i >= 0 && static_cast<std::size_t>(i) < mesh.vertices.size(); });
}

/// Calls visit(half-edge) for each side of each triangle with valid indices, in their order.
template <class Visitor>
void forEachHalfEdge(const TriMesh& mesh, const Visitor& visit) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const TriMesh::Triangle& triangle = mesh.triangles[t];
    if (!validIndices(mesh, triangle)) continue;
    for (std::size_t side = 0; side < 3; ++side) {
      const std::int32_t from = triangle[side], to = triangle[(side + 1) % 3];
      if (from == to) continue;
      visit(HalfEdge{std::min(from, to), std::max(from, to), static_cast<std::int32_t>(t),
                     static_cast<std::int8_t>(side), from < to});
    }
  }
}

/// Sorted by low, high, triangle, side. Each half-edge goes straight to the few of its low vertex, so that the time grows
/// with their number only.
std::vector<HalfEdge> sortedHalfEdges(const TriMesh& mesh) {
  std::vector<std::size_t> end(mesh.vertices.size() + 1, 0);  // of each low vertex
  forEachHalfEdge(mesh, [&](const HalfEdge& edge) { ++end[static_cast<std::size_t>(edge.low) + 1]; });
  for (std::size_t v = 1; v < end.size(); ++v) end[v] += end[v - 1];
  std::vector<HalfEdge> edges(end.back());
  forEachHalfEdge(mesh, [&](const HalfEdge& edge) { edges[end[static_cast<std::size_t>(edge.low)]++] = edge; });
  auto first = edges.begin();
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const auto last = edges.begin() + static_cast<std::ptrdiff_t>(end[v]);
    std::sort(first, last, [](const HalfEdge& a, const HalfEdge& b) {
      return std::tie(a.high, a.triangle, a.side) < std::tie(b.high, b.triangle, b.side);
    });
    first = last;
  }
  return edges;
}

/// Calls visit(first, count) once per edge, with the half-edges of that edge.
template <class Visitor>
void forEachEdge(const std::vector<HalfEdge>& edges, const Visitor& visit) {
  for (std::size_t first = 0; first < edges.size();) {
    std::size_t end = first + 1;
    while (end < edges.size() && edges[end].low == edges[first].low && edges[end].high == edges[first].high) ++end;
    visit(&edges[first], end - first);
    first = end;
  }
}

bool isDegenerate(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, bc = c - b, ca = a - c;
  const double longest_squared = std::max({ab.squaredNorm(), bc.squaredNorm(), ca.squaredNorm()});
  return !(ab.cross(ca).norm() > kFlat * longest_squared);
}

void countVerticesAndTriangles(const TriMesh& mesh, MeshReport& report) {
  for (const Vec3& vertex : mesh.vertices) report.non_finite += !vertex.allFinite();
  for (const TriMesh::Triangle& triangle : mesh.triangles) {
    if (!validIndices(mesh, triangle)) {
      ++report.bad_index;
      continue;
    }
    const auto at = [&](std::size_t i) -> const Vec3& { return mesh.vertices[static_cast<std::size_t>(triangle[i])]; };
    report.degenerate += isDegenerate(at(0), at(1), at(2));
  }
}

}  // namespace

std::size_t degenerateTriangles(const TriMesh& mesh) {
  MeshReport report;
  countVerticesAndTriangles(mesh, report);
  return report.degenerate;
}

void buildAdjacency(TriMesh& mesh) {
  mesh.adjacency.assign(mesh.triangles.size(), {-1, -1, -1});
  forEachEdge(sortedHalfEdges(mesh), [&](const HalfEdge* edge, std::size_t count) {
    if (count != 2) return;
    const auto link = [&](const HalfEdge& from, const HalfEdge& to) {
      mesh.adjacency[static_cast<std::size_t>(from.triangle)][static_cast<std::size_t>(from.side)] = to.triangle;
    };
    link(edge[0], edge[1]);
    link(edge[1], edge[0]);
  });
}

MeshReport checkMesh(const TriMesh& mesh) {
  MeshReport report;
  report.vertices = mesh.vertices.size();
  report.triangles = mesh.triangles.size();
  countVerticesAndTriangles(mesh, report);
  forEachEdge(sortedHalfEdges(mesh), [&](const HalfEdge* edge, std::size_t count) {
    report.open_edges += count == 1;
    report.non_manifold += count > 2;
    report.flipped_edges += count == 2 && edge[0].forward == edge[1].forward;
  });
  const bool whole = report.triangles > 0 && report.bad_index == 0 && report.non_finite == 0;
  report.inverted = whole && report.closed() && report.flipped_edges == 0 && massProperties(mesh).volume < 0;
  return report;
}

}  // namespace presa
