#include "framework/haptics/balanced_forces.h"

namespace presa {

// The force first, then the torque by couples.
void balanceForces(BoundedList<ToolForce>& forces, const Vec6& wrench, double lever) noexcept {
  constexpr double kSlack = 1e-6;  // of the largest resistance to turning: directions below it are left alone
  double total = 0;
  Vec3 centre = Vec3::Zero(), force = wrench.head<3>(), torque = wrench.tail<3>();
  for (const ToolForce& one : forces) {
    total += one.stiffness;
    centre += one.stiffness * one.p_W;
    force -= one.f_W;
  }
  centre /= total;
  Mat3 turning = Mat3::Zero();
  for (ToolForce& one : forces) {
    one.f_W += one.stiffness / total * force;
    torque -= one.p_W.cross(one.f_W);
    const Vec3 arm = one.p_W - centre;
    turning += one.stiffness * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
  }
  turning.diagonal().array() += kSlack * (turning.trace() + 1e-9 * total) + lever * lever * total;
  const Vec3 turn = turning.ldlt().solve(torque);
  for (ToolForce& one : forces) one.f_W += one.stiffness * turn.cross(one.p_W - centre);
}

}  // namespace presa
