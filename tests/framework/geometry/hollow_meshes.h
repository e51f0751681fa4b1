#pragma once
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "framework/geometry/tri_mesh.h"

/// Closed meshes that are not convex.
namespace presa::test {

/// A prism over a simple polygon, counter-clockwise, that its first corner sees all of; from z = 0 to `height`.
inline TriMesh extruded(const std::vector<std::pair<double, double>>& outline, double height) {
  TriMesh mesh;
  const auto n = static_cast<std::int32_t>(outline.size());
  for (const double z : {0.0, height}) {
    for (const auto& [x, y] : outline) mesh.vertices.emplace_back(x, y, z);
  }
  for (std::int32_t i = 0; i < n; ++i) {
    const std::int32_t j = (i + 1) % n;
    mesh.triangles.push_back({i, j, n + j});
    mesh.triangles.push_back({i, n + j, n + i});
    if (i == 0 || j == 0) continue;
    mesh.triangles.push_back({0, j, i});
    mesh.triangles.push_back({n, n + i, n + j});
  }
  buildAdjacency(mesh);
  return mesh;
}

/// A cup of n sides that stands on z = 0: corners at `inner` and `outer` from the axis, a floor of `floor`.
inline TriMesh cup(int n, double inner, double outer, double floor, double height) {
  TriMesh mesh;
  const std::vector<std::pair<double, double>> rings{{outer, 0}, {outer, height}, {inner, height}, {inner, floor}};
  for (const auto& [r, z] : rings) {
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * std::numbers::pi * (i + 0.5) / n;
      mesh.vertices.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
    }
  }
  mesh.vertices.emplace_back(0, 0, 0);
  mesh.vertices.emplace_back(0, 0, floor);
  const std::int32_t below = 4 * n, above = below + 1;
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    for (int ring = 0; ring < 3; ++ring) {
      const int a = ring * n + i, b = ring * n + j, c = a + n, d = b + n;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
    mesh.triangles.push_back({below, j, i});
    mesh.triangles.push_back({above, 3 * n + i, 3 * n + j});
  }
  buildAdjacency(mesh);
  return mesh;
}

}  // namespace presa::test
