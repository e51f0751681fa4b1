#include "modules/fca_mesh/mesh_walk.h"

#include <algorithm>
#include <cmath>

#include "framework/geometry/closest_point.h"

namespace presa::fca {
namespace {

constexpr double kOn = 1e-9;       // share of a corner below which the point lies on the edge opposite
constexpr int kMaxRing = 256;      // triangles around a vertex
constexpr double kNearer = 1e-12;  // relative gain below which a neighbour is no nearer

const TriMesh::Triangle& cornersOf(const TriMesh& mesh, std::int32_t t) noexcept {
  return mesh.triangles[static_cast<std::size_t>(t)];
}
const Vec3& corner(const TriMesh& mesh, std::int32_t t, std::size_t i) noexcept {
  return mesh.vertices[static_cast<std::size_t>(cornersOf(mesh, t)[i])];
}
std::int32_t across(const TriMesh& mesh, std::int32_t t, std::size_t edge) noexcept {
  return mesh.adjacency[static_cast<std::size_t>(t)][edge];
}
/// Twice the area, along the outward normal.
Vec3 areaOf(const TriMesh& mesh, std::int32_t t) noexcept {
  return (corner(mesh, t, 1) - corner(mesh, t, 0)).cross(corner(mesh, t, 2) - corner(mesh, t, 0));
}
Vec3 closest(const TriMesh& mesh, std::int32_t t, const Vec3& g) noexcept {
  return closestOnTriangle(g, corner(mesh, t, 0), corner(mesh, t, 1), corner(mesh, t, 2));
}

/// Where a point of a triangle lies: inside, on one edge, or at a corner.
struct Feature {
  int edge = -1, corner = -1;  ///< edge i leads from corner i to the next
};
Feature featureOf(const TriMesh& mesh, const SurfacePoint& at) noexcept {
  const Vec3 area = areaOf(mesh, at.triangle);
  Feature feature;
  int edges = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec3 &a = corner(mesh, at.triangle, static_cast<std::size_t>(i)),
               &b = corner(mesh, at.triangle, static_cast<std::size_t>((i + 1) % 3));
    if ((b - a).cross(at.q - a).dot(area) > kOn * area.squaredNorm()) continue;
    if (edges++ > 0) feature.corner = i == 2 && feature.edge == 0 ? 0 : i;
    feature.edge = i;
  }
  return feature;
}

/// Calls use(triangle) for every triangle around a corner, itself first.
template <class Use>
void aroundCorner(const TriMesh& mesh, std::int32_t t, std::size_t i, const Use& use) noexcept {
  const std::int32_t vertex = cornersOf(mesh, t)[i];
  const auto indexIn = [&](std::int32_t triangle) {
    const TriMesh::Triangle& corners = cornersOf(mesh, triangle);
    return static_cast<std::size_t>(std::ranges::find(corners, vertex) - corners.begin());
  };
  std::int32_t now = t;
  int left = kMaxRing;
  do {
    use(now);
    now = across(mesh, now, indexIn(now));
  } while (now >= 0 && now != t && --left > 0);
  if (now >= 0) return;
  for (now = across(mesh, t, (i + 2) % 3); now >= 0 && --left > 0;) {  // an open mesh: the other way round, too
    use(now);
    now = across(mesh, now, (indexIn(now) + 2) % 3);
  }
}

/// Calls use(triangle) for every triangle that shares the feature with the given one.
template <class Use>
void sharing(const TriMesh& mesh, std::int32_t t, const Feature& feature, const Use& use) noexcept {
  if (feature.corner >= 0) return aroundCorner(mesh, t, static_cast<std::size_t>(feature.corner), use);
  use(t);
  if (feature.edge < 0) return;
  const std::int32_t other = across(mesh, t, static_cast<std::size_t>(feature.edge));
  if (other >= 0) use(other);
}

}  // namespace

SurfacePoint walk(const TriMesh& mesh, std::int32_t from, const Vec3& g) noexcept {
  SurfacePoint at{from, closest(mesh, from, g)};
  double least = (at.q - g).squaredNorm();
  for (int step = 0; step < kMaxSteps; ++step) {
    SurfacePoint next = at;
    sharing(mesh, at.triangle, featureOf(mesh, at), [&](std::int32_t triangle) {
      const Vec3 q = closest(mesh, triangle, g);
      const double distance = (q - g).squaredNorm();
      if (!(distance < least * (1 - kNearer))) return;
      least = distance;
      next = {triangle, q};
    });
    if (next.triangle == at.triangle) break;
    at = next;
  }
  return at;
}

Vec3 outwardAt(const TriMesh& mesh, const SurfacePoint& point) noexcept {
  const Feature feature = featureOf(mesh, point);
  if (feature.corner < 0) {
    Vec3 sum = Vec3::Zero();
    sharing(mesh, point.triangle, feature, [&](std::int32_t t) { sum += areaOf(mesh, t).normalized(); });
    return sum;
  }
  const std::int32_t vertex = cornersOf(mesh, point.triangle)[static_cast<std::size_t>(feature.corner)];
  Vec3 sum = Vec3::Zero();
  sharing(mesh, point.triangle, feature, [&](std::int32_t t) {
    const auto i = static_cast<std::size_t>(std::ranges::find(cornersOf(mesh, t), vertex) - cornersOf(mesh, t).begin());
    const Vec3 a = (corner(mesh, t, (i + 1) % 3) - corner(mesh, t, i)).normalized(),
               b = (corner(mesh, t, (i + 2) % 3) - corner(mesh, t, i)).normalized();
    sum += std::acos(std::clamp(a.dot(b), -1.0, 1.0)) * areaOf(mesh, t).normalized();
  });
  return sum;
}

}  // namespace presa::fca
