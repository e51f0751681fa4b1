#include "modules/dynamics_ode/friction.h"

#include <cmath>

namespace presa::ode {

double pairFriction(const Material& a, const Material& b, double slip_speed) {
  return slip_speed < kRestSpeed ? std::sqrt(a.friction_static * b.friction_static)
                                 : std::sqrt(a.friction_dynamic * b.friction_dynamic);
}

Vec3 slipDirection(const Vec3& nhat_AB, const Vec3& p_W, const PredictedMotion& A, const PredictedMotion& B) {
  constexpr double kNoSlip = 1e-9;  // [m/s]
  const auto tangential = [&nhat_AB](const Vec3& v) -> Vec3 { return v - v.dot(nhat_AB) * nhat_AB; };
  Vec3 slip = tangential(B.at(p_W) - A.at(p_W));
  if (slip.norm() < kNoSlip) slip = tangential(B.at(p_W));
  if (slip.norm() < kNoSlip) return nhat_AB.unitOrthogonal();
  // twice, so that it is perpendicular to the normal to the last bit
  return tangential(slip.normalized()).normalized();
}

}  // namespace presa::ode
