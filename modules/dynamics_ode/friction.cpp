#include "modules/dynamics_ode/friction.h"

#include <cmath>

namespace presa::ode {

double pairFriction(const Material& a, const Material& b, double slip_speed) {
  return slip_speed < kRestSpeed ? std::sqrt(a.friction_static * b.friction_static)
                                 : std::sqrt(a.friction_dynamic * b.friction_dynamic);
}

Vec3 frictionDirection(const Vec3& nhat_AB, const Vec3& slip) {
  constexpr double kNoSlip = 1e-9;  // [m/s]
  if (!(slip.norm() > kNoSlip)) return nhat_AB.unitOrthogonal();
  // project again, so that the direction is perpendicular to the normal to the last bit
  const Vec3 direction = slip.normalized();
  return (direction - direction.dot(nhat_AB) * nhat_AB).normalized();
}

}  // namespace presa::ode
