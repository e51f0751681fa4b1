#include "framework/geometry/closest_point.h"

#include <algorithm>

namespace presa {

Vec3 closestOnSegment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double along = ab.dot(p - a);
  const double length_squared = ab.squaredNorm();
  if (!(along > 0)) return a;
  if (!(along < length_squared)) return b;
  return a + (along / length_squared) * ab;
}

namespace {

// The minimum over all features: right for every shape, at the price of looking at each.
Vec3 closestOnSliver(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  Vec3 best = closestOnSegment(p, a, b);
  double best_squared = (p - best).squaredNorm();
  const auto consider = [&](const Vec3& candidate) {
    const double squared = (p - candidate).squaredNorm();
    if (squared < best_squared) {
      best = candidate;
      best_squared = squared;
    }
  };
  consider(closestOnSegment(p, b, c));
  consider(closestOnSegment(p, c, a));

  // barycentric weights (times an area squared): all positive when the foot of the perpendicular is inside
  const Vec3 normal = (b - a).cross(c - a);
  const double weight_a = normal.dot((b - p).cross(c - p));
  const double weight_b = normal.dot((c - p).cross(a - p));
  const double weight_c = normal.dot((a - p).cross(b - p));
  if (weight_a > 0 && weight_b > 0 && weight_c > 0) {
    consider((weight_a * a + weight_b * b + weight_c * c) / (weight_a + weight_b + weight_c));
  }
  return best;
}

// Below this sine of the angle at a corner, rounding may put the point into the wrong region.
constexpr double kSliverSine = 1e-4;

}  // namespace

Vec3 closestOnTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, bc = c - b;
  const double ab_ab = ab.squaredNorm(), ac_ac = ac.squaredNorm(), ab_ac = ab.dot(ac);
  // (twice the area)^2 against the two longest edges: small for needles and for flat triangles alike
  const double area = ab_ab * ac_ac - ab_ac * ab_ac;
  const double longest = std::max({ab_ab, ac_ac, bc.squaredNorm()});
  if (!(area > kSliverSine * kSliverSine * longest * longest)) return closestOnSliver(p, a, b, c);

  // corner, edge or inside: the region in which p lies
  const Vec3 ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const double d3 = d1 - ab_ab, d4 = d2 - ab_ac;
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
  const double d5 = d1 - ab_ac, d6 = d2 - ac_ac;
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + bc * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  const double sum = va + vb + vc;
  return a + ab * (vb / sum) + ac * (vc / sum);
}

}  // namespace presa
