#pragma once
#include <algorithm>

#include "framework/core/math/spatial.h"
#include "framework/scene/scene.h"

namespace presa {

/// Where friction lets the god-object go: it stays while it lies within the circle of radius friction times depth around
/// the surface-object, where it would be without friction; if not, it moves towards the circle of dynamic friction, by
/// the part `fraction` of what is beyond it [Harwin & Barrow 2013, 3 and 4.1.1]. A fraction, unlike the step that is
/// printed, makes the rest of the way proportional to speed: viscous friction, up to the normal force. Haptic thread.
inline Vec3 heldByFriction(const Vec3& surface_object, const Vec3& god_object, double depth,
                           const FrictionCoefficients& friction, double fraction, bool& slipping) noexcept {
  const Vec3 lag = god_object - surface_object;
  const double length = lag.norm(), circle = friction.mu_dynamic * depth;
  slipping = length > (slipping ? circle : friction.mu_static * depth);
  if (!slipping) return god_object;
  return surface_object + (circle + std::min(depth, (1 - fraction) * (length - circle))) / length * lag;
}

}  // namespace presa
