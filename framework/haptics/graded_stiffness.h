#pragma once
#include "framework/haptics/surface_effect.h"

namespace presa {

/// At this depth the force of a graded stiffness leans by at most 45 degrees [m]: surface effects refuse more.
inline constexpr double kGradedDepth = 0.002;

/// Whether the force of a stiffness `share` with this slope of the share [1/m] leans by more at kGradedDepth.
inline bool leansTooFar(double slope, double share) { return slope * kGradedDepth / 2 > share; }

/// A stiffness that changes from place to place. Gives the contact the force of the stored energy
/// E = share k (d^2 + t^2) / 2 at the depth d and the tangential displacement t of a finger that sticks: besides the
/// spring's, -(d^2 + t^2) / 2 k * gradient, which pushes towards the softer side. Without it a finger could be pressed
/// into the soft side and let go on the hard one, and would gain energy in each round. While it slips, t is a matter of
/// the depth and friction takes the energy.
/// `share`: of the stiffness where the tool touches, above 0; `gradient`: of the share by the place of the tool, in A
/// [1/m], along the directions in which the touched point can move. Thread: haptic; nonblocking.
inline void gradeStiffness(double share, const Vec3& gradient, const SurfaceInput& input,
                           SurfaceContact& contact) noexcept {
  const double stuck = input.contact.state.slipping ? 0 : contact.tangential.squaredNorm();
  const Vec3 aside = gradient - gradient.dot(contact.nhat) * contact.nhat;
  const Vec3 pushed = contact.depth * contact.nhat - (contact.depth * contact.depth + stuck) / (2 * share) * aside;
  contact.stiffness *= share;
  contact.depth = pushed.norm();
  if (contact.depth > 0) contact.nhat = pushed / contact.depth;
}

}  // namespace presa
