#include "framework/haptics/touched_solids.h"

#include <algorithm>
#include <utility>

#include "framework/haptics/balanced_forces.h"

namespace presa {

TouchedSolids::TouchedSolids(const Scene& scene, std::vector<std::int32_t> bodies)
    : scene_(scene),
      bodies_(std::move(bodies)),
      X_WB_(bodies_.size()),
      friction_(bodies_.size()),
      pressure_(bodies_.size()) {}

void TouchedSolids::place(const ToolInput& input) noexcept {
  for (std::size_t s = 0; s < bodies_.size(); ++s) {
    const Material& material = input.materials[scene_.bodies[static_cast<std::size_t>(bodies_[s])].material];
    X_WB_[s] = input.touchables.frameOf(bodies_[s]);
    friction_[s] = {material.friction_static, material.friction_dynamic};
  }
}

bool TouchedSolids::list(const Pressing& tool, const Vec6& of_handle, BoundedList<ToolForce>& forces) noexcept {
  std::fill(pressure_.begin(), pressure_.end(), 0.0);
  double sum = 0;
  for (const PressedPoint& one : tool.points) {
    pressure_[one.solid] += one.force;
    sum += one.force;
  }
  if (!(sum > 0)) return false;
  const ToolCoupling& handle = tool.coupling;
  const double most = maxSqueeze(handle, tool.radius);
  const double stiffness = handle.stiffness * tool.stiffness / (handle.stiffness + tool.stiffness);
  for (const PressedPoint& one : tool.points) {
    if (!(one.force > 0)) continue;
    const double scale = std::min(1.0, most / pressure_[one.solid]);
    forces.add({.body = bodies_[one.solid],
                .p_W = one.p,
                .nhat_W = one.nhat,
                .f_W = scale * (one.force * one.nhat + one.friction),
                .stiffness = stiffness * one.force / sum,
                .friction_static = friction_[one.solid].mu_static,
                .friction_dynamic = friction_[one.solid].mu_dynamic,
                .slips = tool.sticking.slides(one)});
  }
  balanceForces(forces, -of_handle, tool.lever);
  return true;
}

}  // namespace presa
