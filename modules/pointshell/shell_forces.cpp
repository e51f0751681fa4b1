#include "modules/pointshell/shell_forces.h"

#include <algorithm>
#include <array>
#include <span>

#include "framework/haptics/balanced_forces.h"

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

double pressureOf(const TouchingPoint& one) noexcept { return one.f_T.dot(one.nhat_T); }

/// The contacts of a tool, by body.
class BodyContacts {
 public:
  /// Null: no room for one more body.
  BodyContact* with(std::uint32_t solid) noexcept {
    for (std::size_t b = 0; b < count_; ++b) {
      if (bodies_[b].solid == solid) return &bodies_[b];
    }
    if (count_ == bodies_.size()) return nullptr;
    bodies_[count_].solid = solid;
    return &bodies_[count_++];
  }
  std::span<BodyContact> all() noexcept { return {bodies_.data(), count_}; }

 private:
  std::array<BodyContact, ShellForces::kMaxBodies> bodies_;
  std::size_t count_ = 0;
};

/// Sorts the points into octants around the middle of their body's contact. False: a body found no room.
bool sort(const BoundedList<TouchingPoint>& touching, BodyContacts& contacts) noexcept {
  bool complete = true;
  for (const TouchingPoint& one : touching) {
    BodyContact* body = contacts.with(one.solid);
    complete = complete && body != nullptr;
    if (body == nullptr) continue;
    body->centre += pressureOf(one) * one.p_T;
    body->pressure += pressureOf(one);
  }
  for (BodyContact& body : contacts.all()) body.centre /= std::max(body.pressure, 1e-300);
  for (const TouchingPoint& one : touching) {
    BodyContact* body = contacts.with(one.solid);
    if (body == nullptr) continue;
    const Vec3 from = one.p_T - body->centre;
    Octant& octant = body->octants[(from.x() > 0 ? 1U : 0U) | (from.y() > 0 ? 2U : 0U) | (from.z() > 0 ? 4U : 0U)];
    const double pressure = pressureOf(one);
    octant.f_T += one.f_T;
    octant.place += pressure * one.p_T;
    octant.normals += pressure * one.nhat_T;
    octant.pressure += pressure;
    octant.sticks = octant.sticks || !one.slips;
  }
  return complete;
}

/// In T until balanceForces() has seen it.
ToolForce forceOf(const Octant& octant) noexcept {
  const bool has_normal = octant.normals.norm() > 1e-9 * octant.pressure;
  return {.p_W = octant.place / octant.pressure,
          .nhat_W = has_normal ? Vec3(octant.normals.normalized()) : Vec3(octant.f_T.normalized()),
          .f_W = octant.f_T,
          .slips = !octant.sticks};
}

}  // namespace

bool ShellForces::add(const BoundedList<TouchingPoint>& touching, const Pose& X_WT, const std::vector<Solid>& solids,
                      const std::vector<FrictionCoefficients>& friction, double stiffness, const Vec6& wrench_T,
                      BoundedList<ToolForce>& forces) noexcept {
  BodyContacts contacts;
  const bool complete = sort(touching, contacts);
  double pressure = 0;
  for (const BodyContact& body : contacts.all()) pressure += body.pressure;
  if (!(pressure > 0)) return complete;
  for (const BodyContact& body : contacts.all()) {
    for (const Octant& octant : body.octants) {
      if (!(octant.pressure > 0)) continue;
      ToolForce force = forceOf(octant);
      force.body = solids[body.solid].body;
      force.stiffness = stiffness * octant.pressure / pressure;
      force.friction_static = friction[body.solid].mu_static;
      force.friction_dynamic = friction[body.solid].mu_dynamic;
      forces.add(force);
    }
  }
  balanceForces(forces, wrench_T);
  for (ToolForce& one : forces) {
    one.p_W = X_WT * one.p_W;
    one.nhat_W = X_WT.q * one.nhat_W;
    one.f_W = X_WT.q * one.f_W;
  }
  return complete;
}

}  // namespace presa
