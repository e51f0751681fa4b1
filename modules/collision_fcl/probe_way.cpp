#include "modules/collision_fcl/probe_way.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "framework/geometry/closest_point.h"

namespace presa {
namespace {

/// Boxes are that much larger, relative to their size and distance [-]: those of Presa's hierarchy have axes that are
/// orthonormal to single precision only.
constexpr double kRounding = 1e-6;

double fromSegment(const Vec3& p, const Vec3& a, const Vec3& b) { return (p - closestOnSegment(p, a, b)).norm(); }

/// The min over the ends, and between the lines where their nearest points lie on both segments.
double betweenSegments(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b) {
  double least = std::min({fromSegment(p, a, b), fromSegment(q, a, b), fromSegment(a, p, q), fromSegment(b, p, q)});
  const Vec3 u = q - p, v = b - a, w = p - a;
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), determinant = uu * vv - uv * uv;
  if (!(determinant > 0)) return least;
  const double s = (uv * v.dot(w) - vv * u.dot(w)) / determinant, t = (uu * v.dot(w) - uv * u.dot(w)) / determinant;
  if (s > 0 && s < 1 && t > 0 && t < 1) least = std::min(least, (w + s * u - t * v).norm());
  return least;
}

/// A crossing so close to an edge that rounding hides it is found as the distance from that edge.
bool crosses(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = (b - a).cross(c - a);
  const double before = normal.dot(p - a), after = normal.dot(q - a);
  if ((before > 0) == (after > 0) || before == after) return false;
  const Vec3 at = p + before / (before - after) * (q - p);
  return normal.dot((b - a).cross(at - a)) >= 0 && normal.dot((c - b).cross(at - b)) >= 0 &&
         normal.dot((a - c).cross(at - c)) >= 0;
}

}  // namespace

double ProbeWay::distanceOf(const Vec3& p) const noexcept { return fromSegment(p, from, to); }

bool ProbeWay::mayTouch(const Mat3& axes, const Vec3& center, const Vec3& half) const noexcept {
  const double rounding = kRounding * (half.sum() + center.cwiseAbs().sum() + radius);
  const Vec3 a = axes.transpose() * (from - center), b = axes.transpose() * (to - center);
  // a ball around the capsule against the box
  const double around = radius + 0.5 * (b - a).norm() + rounding;
  const Vec3 beyond = ((0.5 * (a + b)).cwiseAbs() - half).cwiseMax(0.0);
  if (beyond.squaredNorm() > around * around) return false;
  // the segment against the box enlarged by the radius, side by side
  const Vec3 reach = half + Vec3::Constant(radius + rounding);
  double begin = 0, end = 1;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double way = b[i] - a[i];
    if (way == 0) {
      if (std::abs(a[i]) > reach[i]) return false;
      continue;
    }
    const double one = (-reach[i] - a[i]) / way, two = (reach[i] - a[i]) / way;
    begin = std::max(begin, std::min(one, two));
    end = std::min(end, std::max(one, two));
  }
  return !(begin > end);
}

bool ProbeWay::holds(const Vec3& center, const Vec3& half) const noexcept {
  const double rounding = kRounding * (half.sum() + center.cwiseAbs().sum());
  return distanceOf(center) + half.norm() + rounding <= radius;
}

double distance(const ProbeWay& way, const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  const Vec3 &p = way.from, &q = way.to;
  const double to_p = (p - closestOnTriangle(p, a, b, c)).norm();
  if (p == q) return to_p;
  if (crosses(p, q, a, b, c)) return 0;
  return std::min({to_p, (q - closestOnTriangle(q, a, b, c)).norm(), betweenSegments(p, q, a, b),
                   betweenSegments(p, q, b, c), betweenSegments(p, q, c, a)});
}

bool reaches(const ProbeWay& way, const MeshTree& mesh, std::int32_t facet) noexcept {
  const MeshTree::Facet& f = mesh.facet(facet);
  const std::array<const Vec3*, 3> corners{&mesh.corner(f, 0), &mesh.corner(f, 1), &mesh.corner(f, 2)};
  for (const Vec3* corner : corners) {
    if (way.distanceOf(*corner) <= way.radius) return true;
  }
  return distance(way, *corners[0], *corners[1], *corners[2]) <= way.radius;
}

}  // namespace presa
