#pragma once
#include <cstddef>

#include "modules/dynamics_ode/body_contact.h"
#include "modules/dynamics_ode/body_set.h"

namespace presa::ode {

/// The circle along which a contact runs on a body: the rim of a cylinder that wobbles on a plane. The lowest point of
/// the rim moves faster than any point of the body.
struct Rim {
  Vec3 p_CmO_B = Vec3::Zero(), axis_B = Vec3::UnitZ();  ///< centre and unit normal, in the axes of the body
  double radius = 0;                                    ///< [m]; 0: the contact stays where it is on the body

  explicit operator bool() const noexcept { return radius > 0; }
  /// From the centre of mass to the point farthest in the direction `towards_W`.
  Vec3 farthest(const Quat& q_WB, const Vec3& towards_W) const;
};

/// The rim of body `i` on which `contact` lies, when that is where the body reaches farthest in the unit direction
/// `towards_W`, to the other body; else none.
Rim rimAt(const BodySet& bodies, std::size_t i, const BodyContact& contact, const Vec3& towards_W);

}  // namespace presa::ode
