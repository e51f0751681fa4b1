#include "modules/dynamics_ode/contact_solver/rim.h"

#include <cmath>

namespace presa::ode {
namespace {

constexpr double kMinTilt = 1e-3;      // sine, from lying flat and from lying on the side
constexpr double kOnRim = 1 - 1e-3;    // part of radius and length at which a point counts as on the rim
constexpr double kNoDirection = 1e-9;  // towards_W along the axis: every point is as far

}  // namespace

Vec3 Rim::farthest(const Quat& q_WB, const Vec3& towards_W) const {
  const Vec3 axis = q_WB * axis_B, radial = towards_W - towards_W.dot(axis) * axis, p_CmO_W = q_WB * p_CmO_B;
  const double length = radial.norm();
  return length > kNoDirection ? Vec3(p_CmO_W + radius / length * radial) : p_CmO_W;
}

Rim rimAt(const BodySet& bodies, std::size_t i, const BodyContact& contact, const Vec3& towards_W) {
  const Hull* hull = bodies.hull(i);
  if (hull == nullptr || !hull->cylinder || !bodies.awake(i)) return {};
  const auto [radius, length] = *hull->cylinder;
  const Pose X_WG = bodies.geomPose(i);
  const Vec3 towards = X_WG.q.conjugate() * towards_W;
  const Vec3 p = X_WG.inverseTimes(contact.p_W + contact.depth / 2 * towards_W);
  const double tilt = towards.head<2>().norm();
  if (tilt < kMinTilt || std::abs(towards.z()) < kMinTilt) return {};
  if (std::abs(p.z()) < kOnRim * length / 2 || p.head<2>().dot(towards.head<2>()) < kOnRim * radius * tilt) return {};
  const BodySet::Motion motion = bodies.motion(i);
  const Quat q_BW = motion.q_WB.conjugate();
  const Vec3 p_WO = X_WG * Vec3(0, 0, std::copysign(length / 2, p.z()));
  return {q_BW * (p_WO - motion.p_WCm), q_BW * (X_WG.q * Vec3::UnitZ()), radius};
}

}  // namespace presa::ode
