#include "modules/fca_mesh/mesh_walk.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "framework/geometry/closest_point.h"

namespace presa::fca {
namespace {

constexpr double kOn = 1e-9;       // share of a corner below which the point lies on the edge opposite
constexpr int kMaxRing = 256;      // triangles around a vertex
constexpr double kThin = 1e-4;     // squared sine of an angle below which a triangle needs the exact walk
constexpr double kNearer = 1e-12;  // relative gain below which a neighbour is no nearer

/// 0, 1 or 2 without a branch, which no processor could predict here.
std::size_t indexOf(bool is_1, bool is_2) noexcept {
  return std::min<std::size_t>(2, static_cast<std::size_t>(is_1) + 2 * static_cast<std::size_t>(is_2));
}
/// Edge of triangle t across which `other` lies, which must be its neighbour.
std::size_t edgeTo(const WalkMesh& mesh, std::int32_t t, std::int32_t other) noexcept {
  return indexOf(mesh.face(t).across[1] == other, mesh.face(t).across[2] == other);
}
/// Twice the area, along the outward normal.
Vec3 areaOf(const WalkMesh& mesh, std::int32_t t) noexcept {
  const auto& [a, b, c] = mesh.face(t).corners;
  return (b - a).cross(c - a);
}
PreparedTriangle prepared(const WalkMesh& mesh, std::int32_t t) noexcept {
  const auto& [a, b, c] = mesh.face(t).corners;
  return {a, b, c};
}

/// Shares of a point's foot on the plane of a triangle, times `area`: that of edge i is what the corner opposite has,
/// and negative beyond the edge.
struct EdgeShares {
  EdgeShares(const PreparedTriangle& t, const Vec3& p) noexcept : area(t.ab_ab * t.ac_ac - t.ab_ac * t.ab_ac) {
    const Vec3 ap = p - t.a;
    const double d1 = t.ab.dot(ap), d2 = t.ac.dot(ap);
    const double b = t.ac_ac * d1 - t.ab_ac * d2, c = t.ab_ab * d2 - t.ab_ac * d1;
    of = {c, area - b - c, b};
  }
  std::array<double, 3> of;
  double area;  ///< twice the triangle's, squared
};

/// Feature of the triangle on which its point q lies.
Feature featureOf(const PreparedTriangle& t, const Vec3& q) noexcept {
  const EdgeShares shares(t, q);
  Feature feature;
  for (int i = 0; i < 3; ++i) {
    if (shares.of[static_cast<std::size_t>(i)] > kOn * shares.area) continue;
    if (feature.edge >= 0) feature.corner = i == 2 && feature.edge == 0 ? 0 : i;
    feature.edge = i;
  }
  return feature;
}

/// Calls use(triangle) for every triangle around a corner, itself first.
template <class Use>
void aroundCorner(const WalkMesh& mesh, std::int32_t t, std::size_t i, const Use& use) noexcept {
  const std::int32_t vertex = mesh.vertex(t, i);
  std::int32_t now = t;
  int left = kMaxRing;
  do {
    use(now);
    now = mesh.face(now).across[mesh.indexIn(now, vertex)];
  } while (now >= 0 && now != t && --left > 0);
  if (now >= 0) return;
  for (now = mesh.face(t).across[(i + 2) % 3]; now >= 0 && --left > 0;) {  // an open mesh: the other way round, too
    use(now);
    now = mesh.face(now).across[(mesh.indexIn(now, vertex) + 2) % 3];
  }
}

/// Calls use(triangle) for every triangle that shares the point's feature, with the point's own.
template <class Use>
void sharing(const WalkMesh& mesh, const SurfacePoint& at, const Use& use) noexcept {
  if (at.feature.corner >= 0) return aroundCorner(mesh, at.triangle, static_cast<std::size_t>(at.feature.corner), use);
  use(at.triangle);
  if (at.feature.edge < 0) return;
  const std::int32_t other = mesh.face(at.triangle).across[static_cast<std::size_t>(at.feature.edge)];
  if (other >= 0) use(other);
}

/// From one plane to the next towards g, as long as g lies beyond the edge in the plane that is left and within it in
/// the next: every such step brings the half-plane nearer. True where the foot of g lies inside the triangle; then it
/// is the nearest point there, and no neighbour is to be asked. Else at.triangle is where the exact walk begins.
bool glide(const WalkMesh& mesh, const Vec3& g, SurfacePoint& at) noexcept {
  std::int32_t now = at.triangle;
  for (int step = 0; step < kMaxSteps; ++step) {
    const PreparedTriangle t = prepared(mesh, now);
    const EdgeShares shares(t, g);
    if (!(shares.area > kThin * t.ab_ab * t.ac_ac)) return false;
    if (step > 0) {
      if (!(shares.of[edgeTo(mesh, now, at.triangle)] > 0)) return false;  // the edge itself holds it
      at.triangle = now;
    }
    const double smallest = std::min({shares.of[0], shares.of[1], shares.of[2]});
    if (smallest > kOn * shares.area) {
      at.q = t.a + t.ab * (shares.of[2] / shares.area) + t.ac * (shares.of[0] / shares.area);
      mesh.fetchAround(now);
      return true;
    }
    now = mesh.face(now).across[indexOf(shares.of[1] == smallest, shares.of[2] == smallest)];
    if (now < 0) return false;
  }
  return false;
}

}  // namespace

WalkMesh::WalkMesh(const TriMesh& mesh) : mesh_(mesh), faces_(mesh.triangles.size()) {
  for (std::size_t t = 0; t < faces_.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i)
      faces_[t].corners[i] = mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][i])];
    faces_[t].across = mesh.adjacency[t];
  }
}

std::size_t WalkMesh::indexIn(std::int32_t t, std::int32_t vertex) const noexcept {
  const TriMesh::Triangle& corners = mesh_.triangles[static_cast<std::size_t>(t)];
  return static_cast<std::size_t>(std::ranges::find(corners, vertex) - corners.begin());
}

SurfacePoint walk(const WalkMesh& mesh, std::int32_t from, const Vec3& g) noexcept {
  SurfacePoint at;
  at.triangle = from;
  if (glide(mesh, g, at)) return at;
  const PreparedTriangle first = prepared(mesh, at.triangle);
  at.q = closestOnTriangle(g, first);
  at.feature = featureOf(first, at.q);
  double least = (at.q - g).squaredNorm();
  for (int step = 0; step < kMaxSteps; ++step) {
    SurfacePoint next = at;
    sharing(mesh, at, [&](std::int32_t triangle) {
      if (triangle == at.triangle) return;
      const PreparedTriangle t = prepared(mesh, triangle);
      const Vec3 q = closestOnTriangle(g, t);
      const double distance = (q - g).squaredNorm();
      if (!(distance < least * (1 - kNearer))) return;
      least = distance;
      next = {triangle, q, featureOf(t, q)};
    });
    if (next.triangle == at.triangle) break;
    at = next;
  }
  return at;
}

Vec3 outwardAt(const WalkMesh& mesh, const SurfacePoint& point) noexcept {
  if (point.feature.corner < 0) {
    if (point.feature.edge < 0) return areaOf(mesh, point.triangle);
    Vec3 sum = Vec3::Zero();
    sharing(mesh, point, [&](std::int32_t t) { sum += areaOf(mesh, t).normalized(); });
    return sum;
  }
  const std::int32_t vertex = mesh.vertex(point.triangle, static_cast<std::size_t>(point.feature.corner));
  Vec3 sum = Vec3::Zero();
  sharing(mesh, point, [&](std::int32_t t) {
    const auto& corners = mesh.face(t).corners;
    const std::size_t i = mesh.indexIn(t, vertex);
    const Vec3 a = (corners[(i + 1) % 3] - corners[i]).normalized(),
               b = (corners[(i + 2) % 3] - corners[i]).normalized();
    sum += std::acos(std::clamp(a.dot(b), -1.0, 1.0)) * areaOf(mesh, t).normalized();
  });
  return sum;
}

}  // namespace presa::fca
