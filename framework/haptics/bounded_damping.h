#pragma once
#include <algorithm>
#include <cmath>

#include "framework/core/math/spatial.h"

namespace presa {

/// `force` + s `damper` [N], s from 0 to 1 the largest for which the sum is at most `max` [N]: the bound takes from the
/// damper alone, so that a conservative force stays one and the damper still only takes energy. |force| <= max.
/// Thread: any; nonblocking.
inline Vec3 withDamping(const Vec3& force, const Vec3& damper, double max) noexcept {
  const Vec3 sum = force + damper;
  if (sum.squaredNorm() <= max * max) return sum;
  // |force + s damper|^2 = max^2
  const double a = damper.squaredNorm(), b = force.dot(damper), c = force.squaredNorm() - max * max;
  const double root = std::sqrt(std::max(0.0, b * b - a * c));
  const double s = b > 0 ? -c / (b + root) : (root - b) / a;  // the sum without cancellation
  return force + std::clamp(s, 0.0, 1.0) * damper;
}

}  // namespace presa
