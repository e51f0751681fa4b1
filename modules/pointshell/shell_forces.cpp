#include "modules/pointshell/shell_forces.h"

namespace presa {

bool ShellForces::add(const BoundedList<TouchingPoint>& touching, const Pose& X_WT, const std::vector<Solid>& solids,
                      const std::vector<FrictionCoefficients>& friction, double stiffness, const Vec6& wrench_T,
                      BoundedList<ToolForce>& forces) noexcept {
  const auto small = [](const TouchingPoint& one) {
    return SmallForce{one.solid, one.p_T, one.nhat_T, one.f_T, one.slips};
  };
  GatheredForces gathered;
  bool complete = true;
  for (const TouchingPoint& one : touching) complete = gathered.weigh(small(one)) && complete;
  for (const TouchingPoint& one : touching) gathered.add(small(one));
  gathered.write(
      stiffness, wrench_T,
      [&](std::uint32_t solid, ToolForce& force) {
        force.body = solids[solid].body;
        force.friction_static = friction[solid].mu_static;
        force.friction_dynamic = friction[solid].mu_dynamic;
      },
      forces);
  for (ToolForce& one : forces) {
    one.p_W = X_WT * one.p_W;
    one.nhat_W = X_WT.q * one.nhat_W;
    one.f_W = X_WT.q * one.f_W;
  }
  return complete;
}

}  // namespace presa
