#include "devices/percro_arm/kinematics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace presa::percro {
namespace {

Mat3 turn(double angle, const Vec3& axis) { return Eigen::AngleAxisd(angle, axis).toRotationMatrix(); }

}  // namespace

Mat3 transmission(const Geometry& g) {
  const double a = g.tilt_ratio, b = g.tilt_ratio * g.yaw_ratio;
  Mat3 k;
  k << -a, -b, 0, a, -b, 0, 0, 0, -1 / g.drum_radius;
  return k;
}

Mat3 transmissionInverse(const Geometry& g) {
  const double a = 0.5 / g.tilt_ratio, b = 0.5 / (g.tilt_ratio * g.yaw_ratio);
  Mat3 k;
  k << -a, a, 0, -b, -b, 0, 0, 0, -g.drum_radius;
  return k;
}

Mat3 barrelFrame(const Joints& q) {
  const double c1 = std::cos(q[0]), s1 = std::sin(q[0]), c2 = std::cos(q[1]), s2 = std::sin(q[1]);
  Mat3 r;
  r << c1 * c2, -s1, c1 * s2, s1 * c2, c1, s1 * s2, -s2, 0, c2;
  return r;
}

Vec3 tipPosition(const Geometry& g, const Joints& q) { return (g.length_min + q[2]) * barrelFrame(q).col(0); }

Mat3 jacobian(const Geometry& g, const Joints& q) {
  const double c1 = std::cos(q[0]), s1 = std::sin(q[0]), c2 = std::cos(q[1]), s2 = std::sin(q[1]);
  const double length = g.length_min + q[2];
  Mat3 j;
  j << -length * s1 * c2, -length * c1 * s2, c1 * c2,  //
      length * c1 * c2, -length * s1 * s2, s1 * c2,    //
      0, -length * c2, -s2;
  return j;
}

Joints jointsAt(const Geometry& g, const Vec3& p) {
  const double across = std::hypot(p.x(), p.y());
  return {std::atan2(p.y(), p.x()), std::atan2(-p.z(), across), std::hypot(across, p.z()) - g.length_min};
}

bool withinReach(const Geometry& g, const Joints& q, double tolerance) {
  return std::abs(q[0]) <= g.tilt_range + tolerance && std::abs(q[1]) <= g.yaw_range + tolerance &&
         q[2] >= -tolerance && q[2] <= g.length_max - g.length_min + tolerance;
}

Singularity singularityAt(const Geometry& g, const Joints& q, double tolerance) {
  if (std::abs(g.length_min + q[2]) <= tolerance * g.length_min) return Singularity::kTipAtCentre;
  return std::abs(std::cos(q[1])) <= tolerance ? Singularity::kBarrelAlongTiltAxis : Singularity::kNone;
}

Vec3 gains(const Geometry& g, const Joints& q) {
  const double per_turn = std::abs(g.length_min + q[2]) / (std::numbers::sqrt2 * g.tilt_ratio);
  return {per_turn * std::abs(std::cos(q[1])), per_turn / g.yaw_ratio, g.drum_radius};
}

double conditionNumber(const Geometry& g, const Joints& q) {
  const Vec3 values = gains(g, q);
  const double min = values.minCoeff();
  return min > 0 ? values.maxCoeff() / min : std::numeric_limits<double>::infinity();
}

double transverseStep(const Parameters& p, double length) { return length * p.motors.count() / p.geometry.tilt_ratio; }

double axialStep(const Parameters& p) { return p.geometry.drum_radius * p.motors.count(); }

Mat3 thimbleFrame(const Joints& q, const Vec3& wrist) {
  return barrelFrame(q) * turn(wrist[0], Vec3::UnitX()) * turn(wrist[1], Vec3::UnitY()) * turn(wrist[2], Vec3::UnitZ());
}

Vec3 wristAt(const Joints& q, const Mat3& R_DT) {
  const Mat3 r = barrelFrame(q).transpose() * R_DT;
  const double cosine = std::hypot(r(0, 0), r(0, 1)), pitch = std::atan2(r(0, 2), cosine);
  if (cosine < 1e-9) return {std::atan2(r(2, 1), r(1, 1)), pitch, 0};
  return {std::atan2(-r(1, 2), r(2, 2)), pitch, std::atan2(-r(0, 1), r(0, 0))};
}

}  // namespace presa::percro
