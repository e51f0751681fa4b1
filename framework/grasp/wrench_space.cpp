#include "framework/grasp/wrench_space.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

namespace presa {

double gyrationLength(double mass, const Mat3& inertia) { return std::sqrt(inertia.trace() / (2 * mass)); }

WrenchSpace::WrenchSpace(const GraspSnapshot& grasp, GripBound bound) : grasp_(grasp), bound_(bound) {}

// With f_n = 1 the contact's force is n + mu d, d in the unit disc across n, and its torque r mu t n, |t| <= 1. Their
// power on the motion u is largest where d follows the velocity of the contact point across n, and t the spin about n.
double WrenchSpace::ofContact(const GraspContact& contact, const Vec6& u, Vec6& point) const {
  const Vec3 arm = contact.p - grasp_.centre, w = u.tail<3>() / grasp_.length;
  const Vec3 v = u.head<3>() + w.cross(arm);
  Vec3 across = v - v.dot(contact.inward) * contact.inward;
  across -= across.dot(contact.inward) * contact.inward;  // where v is along the normal, the rounding was, too
  const double speed = across.norm(), spin = w.dot(contact.inward);
  Vec3 f = contact.inward;
  if (speed > 0) f += contact.friction / speed * across;
  const double torque = contact.torsion * contact.friction * (spin < 0 ? -1 : 1);
  point << f, (arm.cross(f) + torque * contact.inward) / grasp_.length;
  return u.dot(point);
}

double WrenchSpace::pressing(const Vec6& u, Vec6& point) const {
  double best = -std::numeric_limits<double>::infinity();
  for (const GraspContact& contact : grasp_.contacts) {
    Vec6 own;
    const double power = ofContact(contact, u, own);
    if (power <= best) continue;
    best = power;
    point = own;
  }
  return best;
}

double WrenchSpace::support(const Vec6& u, Vec6& point) const {
  if (bound_ == GripBound::kSum) {
    const double best = pressing(u, point);
    if (best > 0) return best;
    point.setZero();
    return 0;
  }
  double sum = 0;
  point.setZero();
  for (const GraspContact& contact : grasp_.contacts) {
    Vec6 own;
    const double power = ofContact(contact, u, own);
    if (power <= 0) continue;
    sum += contact.max_normal * power;
    point += contact.max_normal * own;
  }
  return sum;
}

Eigen::Matrix<double, 6, Eigen::Dynamic> WrenchSpace::span() const {
  constexpr double kFlat = 1e-6;
  Eigen::Matrix<double, 6, Eigen::Dynamic> generators(6, 4 * static_cast<Eigen::Index>(grasp_.contacts.size()));
  Eigen::Index column = 0;
  for (const GraspContact& contact : grasp_.contacts) {
    const Vec3 arm = contact.p - grasp_.centre;
    const auto add = [&](const Vec3& f, const Vec3& torque) {
      generators.col(column++) << f, (arm.cross(f) + torque) / grasp_.length;
    };
    const Vec3 t1 = contact.inward.unitOrthogonal(), t2 = contact.inward.cross(t1);
    add(contact.inward, Vec3::Zero());
    add(contact.friction * t1, Vec3::Zero());
    add(contact.friction * t2, Vec3::Zero());
    add(Vec3::Zero(), contact.friction * contact.torsion * contact.inward);
  }
  // ascending eigenvalues: the squares of the widths
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> axes(generators * generators.transpose());
  Eigen::Index across = 0;
  while (across < 6 && axes.eigenvalues()[across] <= kFlat * kFlat * axes.eigenvalues()[5]) ++across;
  return axes.eigenvectors().rightCols(6 - across);
}

}  // namespace presa
