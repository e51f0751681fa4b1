#include "framework/haptics/gathered_forces.h"

#include <algorithm>

namespace presa {

GatheredForces::BodyContact* GatheredForces::with(std::uint32_t solid) noexcept {
  for (std::size_t b = 0; b < count_; ++b) {
    if (bodies_[b].solid == solid) return &bodies_[b];
  }
  if (count_ == bodies_.size()) return nullptr;
  bodies_[count_].solid = solid;
  return &bodies_[count_++];
}

bool GatheredForces::weigh(const SmallForce& force) noexcept {
  BodyContact* body = with(force.solid);
  if (body == nullptr) return false;
  body->moment += force.pressure() * force.p;
  body->pressure += force.pressure();
  return true;
}

void GatheredForces::add(const SmallForce& force) noexcept {
  BodyContact* body = with(force.solid);
  if (body == nullptr) return;
  const Vec3 from = force.p - body->moment / std::max(body->pressure, 1e-300);
  Octant& octant = body->octants[(from.x() > 0 ? 1U : 0U) | (from.y() > 0 ? 2U : 0U) | (from.z() > 0 ? 4U : 0U)];
  const double pressure = force.pressure();
  octant.f += force.f;
  octant.place += pressure * force.p;
  octant.normals += pressure * force.nhat;
  octant.pressure += pressure;
  octant.sticks = octant.sticks || !force.slips;
}

ToolForce GatheredForces::forceOf(const Octant& octant) noexcept {
  const bool has_normal = octant.normals.norm() > 1e-9 * octant.pressure;
  return {.p_W = octant.place / octant.pressure,
          .nhat_W = has_normal ? Vec3(octant.normals.normalized()) : Vec3(octant.f.normalized()),
          .f_W = octant.f,
          .slips = !octant.sticks};
}

}  // namespace presa
