#include "modules/pointshell/shell_forces.h"

#include <algorithm>
#include <array>

namespace presa {
namespace {

/// Points of one octant of the contact with one body.
struct Octant {
  Vec3 f_T = Vec3::Zero(), place = Vec3::Zero(), normals = Vec3::Zero();
  double pressure = 0;  // sum of the normal forces [N]
  bool sticks = false;
};

/// Contact with one body.
struct BodyContact {
  std::uint32_t solid = 0;
  Vec3 centre = Vec3::Zero();
  double pressure = 0;
  std::array<Octant, 8> octants;
};

/// Changes the forces, given in T, so that their sum is `wrench_T`, with the stiffnesses as weights: the force exactly,
/// then the torque by couples, as far as places that lie apart can give it.
void balance(BoundedList<ToolForce>& forces, const Vec6& wrench_T) noexcept {
  constexpr double kSlack = 1e-6;  // of the largest resistance to turning: directions below it are left alone
  double total = 0;
  Vec3 centre = Vec3::Zero(), force = wrench_T.head<3>(), torque = wrench_T.tail<3>();
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
  turning.diagonal().array() += kSlack * (turning.trace() + 1e-9 * total);
  const Vec3 turn = turning.ldlt().solve(torque);
  for (ToolForce& one : forces) one.f_W += one.stiffness * turn.cross(one.p_W - centre);
}

double pressureOf(const TouchingPoint& one) noexcept { return one.f_T.dot(one.nhat_T); }

}  // namespace

void ShellForces::add(const BoundedList<TouchingPoint>& touching, const Pose& X_WT, const std::vector<Solid>& solids,
                      const std::vector<FrictionCoefficients>& friction, double stiffness, const Vec6& wrench_T,
                      BoundedList<ToolForce>& forces) noexcept {
  std::array<BodyContact, kMaxBodies> bodies;
  std::size_t count = 0;
  const auto contactWith = [&](std::uint32_t solid) -> BodyContact* {
    for (std::size_t b = 0; b < count; ++b) {
      if (bodies[b].solid == solid) return &bodies[b];
    }
    if (count == kMaxBodies) return nullptr;
    bodies[count].solid = solid;
    return &bodies[count++];
  };
  double pressure = 0;
  for (const TouchingPoint& one : touching) {
    BodyContact* body = contactWith(one.solid);
    if (body == nullptr) continue;
    const double p = pressureOf(one);
    body->centre += p * one.p_T;
    body->pressure += p;
    pressure += p;
  }
  if (!(pressure > 0)) return;
  for (std::size_t b = 0; b < count; ++b) bodies[b].centre /= bodies[b].pressure;
  for (const TouchingPoint& one : touching) {
    BodyContact* body = contactWith(one.solid);
    if (body == nullptr) continue;
    const Vec3 from = one.p_T - body->centre;
    Octant& octant = body->octants[(from.x() > 0 ? 1U : 0U) | (from.y() > 0 ? 2U : 0U) | (from.z() > 0 ? 4U : 0U)];
    const double p = pressureOf(one);
    octant.f_T += one.f_T;
    octant.place += p * one.p_T;
    octant.normals += p * one.nhat_T;
    octant.pressure += p;
    octant.sticks = octant.sticks || !one.slips;
  }
  for (std::size_t b = 0; b < count; ++b) {
    const FrictionCoefficients& mu = friction[bodies[b].solid];
    for (const Octant& octant : bodies[b].octants) {
      if (!(octant.pressure > 0)) continue;
      forces.add({.body = solids[bodies[b].solid].body,
                  .p_W = octant.place / octant.pressure,  // in T until balance() has seen it
                  .nhat_W = octant.normals.norm() > 1e-9 * octant.pressure ? Vec3(octant.normals.normalized())
                                                                          : Vec3(octant.f_T.normalized()),
                  .f_W = octant.f_T,
                  .stiffness = stiffness * octant.pressure / pressure,
                  .friction_static = mu.mu_static,
                  .friction_dynamic = mu.mu_dynamic,
                  .slips = !octant.sticks});
    }
  }
  balance(forces, wrench_T);
  for (ToolForce& one : forces) {
    one.p_W = X_WT * one.p_W;
    one.nhat_W = X_WT.q * one.nhat_W;
    one.f_W = X_WT.q * one.f_W;
  }
}

}  // namespace presa
