#include "devices/percro_arm/reach.h"

#include <algorithm>
#include <cmath>

#include "devices/percro_arm/dynamics.h"
#include "devices/percro_arm/steps.h"

namespace presa::percro {
namespace {

constexpr int kGrid = 8;            // steps across a box; even, so that the centre lines are included
constexpr double kRounding = 1e-9;  // of lengths [m]

/// Calls `visit` with grid points of the box, which include the farthest, nearest and most oblique ones.
template <class Visit>
void overBox(const ReachBox& box, const Visit& visit) {
  for (int i = 0; i <= kGrid; ++i) {
    for (int j = 0; j <= kGrid; ++j) {
      for (int k = 0; k <= kGrid; ++k) {
        const Vec3 part = Vec3(i, j, k) / kGrid;
        visit(
            Vec3(box.near + part.x() * box.size.x(), (part.y() - 0.5) * box.size.y(), (part.z() - 0.5) * box.size.z()));
      }
    }
  }
}

template <class Fits>
double largest(const Fits& fits) {
  double low = 0, high = 4;
  while (high - low > 1e-7) (fits((low + high) / 2) ? low : high) = (low + high) / 2;
  return low;
}

}  // namespace

bool reaches(const Geometry& geometry, const ReachBox& box) {
  bool all = true;
  overBox(box, [&](const Vec3& p) { all = all && withinReach(geometry, jointsAt(geometry, p), kRounding); });
  return all;
}

double largestScale(const Geometry& geometry, const Vec3& size) {
  return largest([&](double scale) {
    for (const double near : steps(geometry.length_min, geometry.length_max, 300)) {
      if (reaches(geometry, {scale * size, near})) return true;
    }
    return false;
  });
}

double largestCommonScale(const Geometry& geometry, const Vec3& size, double apart) {
  // centred between the arms, the box looks the same to both
  return largest([&](double scale) { return reaches(geometry, {scale * size, 0.5 * apart - 0.5 * scale * size.x()}); });
}

double forceInAllDirections(const Parameters& parameters, const Joints& q, double torque) {
  const ArmDynamics arm(parameters, {0, -9.81, 0});
  const Mat3 to_motors = transmissionInverse(parameters.geometry).transpose();
  const Vec3 carried = to_motors * arm.weight(q);
  const Mat3 per_force = to_motors * jacobian(parameters.geometry, q).transpose();
  double force = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) force = std::min(force, (torque - std::abs(carried[i])) / per_force.row(i).norm());
  return force;
}

double minForce(const Parameters& parameters, const ReachBox& box, double torque) {
  double force = std::numeric_limits<double>::infinity();
  overBox(box, [&](const Vec3& p) {
    force = std::min(force, forceInAllDirections(parameters, jointsAt(parameters.geometry, p), torque));
  });
  return force;
}

}  // namespace presa::percro
