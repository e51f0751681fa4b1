#include "framework/scene/goal_pose.h"

#include <cmath>
#include <numbers>

namespace presa {

PoseDifference poseDifference(const Pose& a, const Pose& b) {
  const Quat turn = a.q.conjugate() * b.q;
  return {(b.p - a.p).norm(), 2 * std::atan2(turn.vec().norm(), std::abs(turn.w()))};
}

// Swing-twist decomposition: the twist about z of the remaining rotation is the turn that brings the goal nearest.
Pose nearestTurn(const Pose& X_WB, std::size_t fold, const Quat& q_WB) {
  if (fold == 1) return X_WB;
  const Quat rest = X_WB.q.conjugate() * q_WB;
  double twist = 2 * std::atan2(rest.z(), rest.w());
  if (fold > 1) {
    const double part = 2 * std::numbers::pi / static_cast<double>(fold);
    twist = part * std::round(twist / part);
  }
  const Quat turn(std::cos(twist / 2), 0, 0, std::sin(twist / 2));
  return {X_WB.p, (X_WB.q * turn).normalized()};
}

}  // namespace presa
