#include "framework/geometry/decimate.h"

#include <algorithm>

#include "framework/geometry/mesh_decimate_abi.h"
#include "framework/geometry/surface_tree.h"
#include "framework/plugin/plugin_loader.h"

namespace presa {
namespace {

double farthest(const TriMesh& from, const TriMesh& to) {
  const SurfaceTree tree(to);
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

CoarserCorners decimateCorners(const std::vector<float>& places, const std::vector<std::uint32_t>& corners,
                               std::size_t triangles, double max_error) {
  if (3 * triangles >= corners.size()) return {corners, 0};  // meshoptimizer takes that for a mistake and aborts
  const auto simplify = reinterpret_cast<DecimateMeshFunction>(pluginSymbol("mesh_decimate", kMeshDecimateSymbol));
  CoarserCorners out;
  out.corners.resize(corners.size());
  float error = 0;
  out.corners.resize(simplify(corners.data(), corners.size(), places.data(), places.size() / 3, 3 * triangles,
                              static_cast<float>(max_error), out.corners.data(), &error));
  out.error = double{error};
  return out;
}

TriMesh decimateMesh(const TriMesh& mesh, std::size_t triangles, double max_error) {
  std::vector<float> coordinates;
  for (const Vec3& v : mesh.vertices)
    coordinates.insert(coordinates.end(),
                       {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())});
  std::vector<std::uint32_t> indices;
  for (const TriMesh::Triangle& t : mesh.triangles) {
    for (const std::int32_t corner : t) indices.push_back(static_cast<std::uint32_t>(corner));
  }
  const std::vector<std::uint32_t> out = decimateCorners(coordinates, indices, triangles, max_error).corners;
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
