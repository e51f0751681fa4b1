#include "framework/geometry/closest_point.h"

namespace presa {
Vec3 closestOnSegment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double along = ab.dot(p - a);
  const double length_squared = ab.squaredNorm();
  if (!(along > 0)) return a;
  if (!(along < length_squared)) return b;
  return a + (along / length_squared) * ab;
}

Vec3 detail::closestOnSliver(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
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

}  // namespace presa
