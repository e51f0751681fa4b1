#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "framework/geometry/tri_mesh.h"

namespace presa {
namespace {

using std::numbers::pi;

std::int32_t addVertex(TriMesh& mesh, const Vec3& vertex) {
  mesh.vertices.push_back(vertex);
  return static_cast<std::int32_t>(mesh.vertices.size() - 1);
}

/// Appends a horizontal ring of vertices, counter-clockwise from +x; returns the first.
std::int32_t addRing(TriMesh& mesh, double radius, double z, int segments) {
  const auto first = static_cast<std::int32_t>(mesh.vertices.size());
  for (int i = 0; i < segments; ++i) {
    const double angle = 2 * pi * i / segments;
    mesh.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
  }
  return first;
}

/// Joins two rings, `upper` above `lower`, facing outwards.
void joinRings(TriMesh& mesh, std::int32_t lower, std::int32_t upper, int segments) {
  for (int i = 0; i < segments; ++i) {
    const int j = (i + 1) % segments;
    mesh.triangles.push_back({lower + i, lower + j, upper + j});
    mesh.triangles.push_back({lower + i, upper + j, upper + i});
  }
}

/// Closes a ring with a fan around `apex`.
void closeRing(TriMesh& mesh, std::int32_t ring, std::int32_t apex, int segments, bool upwards) {
  for (int i = 0; i < segments; ++i) {
    const int j = (i + 1) % segments;
    if (upwards) {
      mesh.triangles.push_back({apex, ring + i, ring + j});
    } else {
      mesh.triangles.push_back({apex, ring + j, ring + i});
    }
  }
}

TriMesh makeIcosahedron() {
  const double g = std::numbers::phi;
  TriMesh mesh;
  mesh.vertices = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                   {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  return mesh;
}

/// Splits every triangle into four at the middles of its edges.
void subdivide(TriMesh& mesh) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
  const auto middle = [&](std::int32_t a, std::int32_t b) {
    const auto [entry, added] = middles.try_emplace(std::minmax(a, b), static_cast<std::int32_t>(mesh.vertices.size()));
    if (added) {
      const Vec3 sum = mesh.vertices[static_cast<std::size_t>(a)] + mesh.vertices[static_cast<std::size_t>(b)];
      mesh.vertices.emplace_back(sum.normalized());
    }
    return entry->second;
  };
  std::vector<TriMesh::Triangle> finer;
  finer.reserve(4 * mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::int32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  mesh.triangles = std::move(finer);
}

}  // namespace

TriMesh makeBox(const Vec3& size) {
  TriMesh mesh;
  for (int i = 0; i < 8; ++i) {
    const Vec3 sign((i & 1) ? 0.5 : -0.5, (i & 2) ? 0.5 : -0.5, (i & 4) ? 0.5 : -0.5);
    mesh.vertices.emplace_back(sign.cwiseProduct(size));
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  buildAdjacency(mesh);
  return mesh;
}

TriMesh makeSphere(double radius, int subdivisions) {
  TriMesh mesh = makeIcosahedron();
  for (Vec3& vertex : mesh.vertices) vertex.normalize();
  for (int i = 0; i < subdivisions; ++i) subdivide(mesh);
  for (Vec3& vertex : mesh.vertices) vertex *= radius;
  buildAdjacency(mesh);
  return mesh;
}

TriMesh makeCylinder(double radius, double length, int segments) {
  segments = std::max(segments, 3);
  TriMesh mesh;
  const std::int32_t lower = addRing(mesh, radius, -length / 2, segments);
  const std::int32_t upper = addRing(mesh, radius, length / 2, segments);
  joinRings(mesh, lower, upper, segments);
  closeRing(mesh, lower, addVertex(mesh, {0, 0, -length / 2}), segments, false);
  closeRing(mesh, upper, addVertex(mesh, {0, 0, length / 2}), segments, true);
  buildAdjacency(mesh);
  return mesh;
}

TriMesh makeCapsule(double radius, double length, int segments) {
  segments = std::max(segments, 4);
  const int rings = std::max(segments / 4, 1);  // per half-sphere; makes the facets about square
  TriMesh mesh;
  const std::int32_t bottom = addVertex(mesh, {0, 0, -length / 2 - radius});
  std::int32_t previous = -1;
  for (int half = -1; half <= 1; half += 2) {
    // a capsule of length 0 is a sphere: the two equators coincide
    for (int i = half > 0 && length == 0 ? 1 : 0; i < rings; ++i) {
      // lower half: from the pole to the equator; upper half: from the equator to the pole
      const double latitude = 0.5 * pi * (half < 0 ? i + 1 - rings : i) / rings;
      const std::int32_t ring =
          addRing(mesh, radius * std::cos(latitude), half * length / 2 + radius * std::sin(latitude), segments);
      if (previous < 0) {
        closeRing(mesh, ring, bottom, segments, false);
      } else {
        joinRings(mesh, previous, ring, segments);
      }
      previous = ring;
    }
  }
  closeRing(mesh, previous, addVertex(mesh, {0, 0, length / 2 + radius}), segments, true);
  buildAdjacency(mesh);
  return mesh;
}

}  // namespace presa
