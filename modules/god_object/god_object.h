#pragma once
#include "framework/haptics/renderer.h"

namespace presa {

/// Moves a sphere of radius r from x towards g without passing through any piece, to the local minimum of |x - g|: the
/// god-object with finite radius [Zilles1995], [Ruspini1997]. Each leg goes to the exact solution of the active-set
/// programme and is stopped by the first new contact, found by a sweep. Even with contradicting constraints a leg keeps
/// the centre at half its distance from each piece, so it cannot cross a surface. Tolerances are relative to r, and not
/// below the rounding of the coordinates. Thread: haptic; nonblocking.
ProxyMove moveProxy(const Vec3& x, const Vec3& g, double r, Surroundings& surroundings) noexcept;

/// True when a fingertip at x touches at least one piece and overlaps none.
bool isSupported(const Vec3& x, double r, Surroundings& surroundings) noexcept;

/// One tick of the frictionless god-object towards the HIP g.
ProxyContact slideProxy(const ProxyState& last, const Vec3& g, double r, Surroundings& surroundings) noexcept;

}  // namespace presa
