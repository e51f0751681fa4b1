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

const TriMesh::Triangle& cornersOf(const TriMesh& mesh, std::int32_t t) noexcept {
  return mesh.triangles[static_cast<std::size_t>(t)];
}
const Vec3& corner(const TriMesh& mesh, std::int32_t t, std::size_t i) noexcept {
  return mesh.vertices[static_cast<std::size_t>(cornersOf(mesh, t)[i])];
}
std::int32_t across(const TriMesh& mesh, std::int32_t t, std::size_t edge) noexcept {
  return mesh.adjacency[static_cast<std::size_t>(t)][edge];
}
/// 0, 1 or 2 without a branch, which no processor could predict here.
std::size_t indexOf(bool is_1, bool is_2) noexcept {
  return std::min<std::size_t>(2, static_cast<std::size_t>(is_1) + 2 * static_cast<std::size_t>(is_2));
}
/// Edge of triangle t across which `other` lies, which must be its neighbour.
std::size_t edgeTo(const TriMesh& mesh, std::int32_t t, std::int32_t other) noexcept {
  return indexOf(across(mesh, t, 1) == other, across(mesh, t, 2) == other);
}
/// Twice the area, along the outward normal.
Vec3 areaOf(const TriMesh& mesh, std::int32_t t) noexcept {
  return (corner(mesh, t, 1) - corner(mesh, t, 0)).cross(corner(mesh, t, 2) - corner(mesh, t, 0));
}
PreparedTriangle prepared(const TriMesh& mesh, std::int32_t t) noexcept {
  return {corner(mesh, t, 0), corner(mesh, t, 1), corner(mesh, t, 2)};
}

/// Shares of a point's foot on the plane of a triangle, times `area`: that of edge i is what the corner opposite has, and
/// negative beyond the edge.
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

/// Calls use(triangle) for every triangle that shares the point's feature, with the point's own.
template <class Use>
void sharing(const TriMesh& mesh, const SurfacePoint& at, const Use& use) noexcept {
  if (at.feature.corner >= 0) return aroundCorner(mesh, at.triangle, static_cast<std::size_t>(at.feature.corner), use);
  use(at.triangle);
  if (at.feature.edge < 0) return;
  const std::int32_t other = across(mesh, at.triangle, static_cast<std::size_t>(at.feature.edge));
  if (other >= 0) use(other);
}

/// From one plane to the next towards g, as long as g lies beyond the edge in the plane that is left and within it in
/// the next: every such step brings the half-plane nearer. True where the foot of g lies inside the triangle; then it is
/// the nearest point there, and no neighbour is to be asked. Else at.triangle is where the exact walk begins.
bool glide(const TriMesh& mesh, const Vec3& g, SurfacePoint& at) noexcept {
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
      return true;
    }
    now = across(mesh, now, indexOf(shares.of[1] == smallest, shares.of[2] == smallest));
    if (now < 0) return false;
  }
  return false;
}

}  // namespace

SurfacePoint walk(const TriMesh& mesh, std::int32_t from, const Vec3& g) noexcept {
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

Vec3 outwardAt(const TriMesh& mesh, const SurfacePoint& point) noexcept {
  if (point.feature.corner < 0) {
    if (point.feature.edge < 0) return areaOf(mesh, point.triangle);
    Vec3 sum = Vec3::Zero();
    sharing(mesh, point, [&](std::int32_t t) { sum += areaOf(mesh, t).normalized(); });
    return sum;
  }
  const std::int32_t vertex = cornersOf(mesh, point.triangle)[static_cast<std::size_t>(point.feature.corner)];
  Vec3 sum = Vec3::Zero();
  sharing(mesh, point, [&](std::int32_t t) {
    const auto i = static_cast<std::size_t>(std::ranges::find(cornersOf(mesh, t), vertex) - cornersOf(mesh, t).begin());
    const Vec3 a = (corner(mesh, t, (i + 1) % 3) - corner(mesh, t, i)).normalized(),
               b = (corner(mesh, t, (i + 2) % 3) - corner(mesh, t, i)).normalized();
    sum += std::acos(std::clamp(a.dot(b), -1.0, 1.0)) * areaOf(mesh, t).normalized();
  });
  return sum;
}

}  // namespace presa::fca
