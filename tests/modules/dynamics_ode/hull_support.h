#pragma once
#include <algorithm>

#include "framework/geometry/convex_contact/manifold.h"

/// Contacts of two hulls, for tests.
namespace presa::ode {

/// Without a memory of steps before.
inline Manifold contactOf(const Hull& A, const Hull& B, double margin) {
  ManifoldMaker maker;
  ContactAxis memory;
  Manifold manifold;
  maker.collide(A, B, margin, memory, manifold);
  return manifold;
}

inline double deepest(const Manifold& manifold) {
  double gap = 1e300;
  for (int i = 0; i < manifold.count; ++i) gap = std::min(gap, manifold.points[static_cast<std::size_t>(i)].gap);
  return gap;
}

}  // namespace presa::ode
