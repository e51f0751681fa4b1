#pragma once
#include "devices/percro_arm/kinematics.h"

/// What an arm reaches, and with what force. Thread: any.
namespace presa::percro {

/// Box with faces along D's axes: sizes along x, y, z [m], its near face at x = near, centred on the x axis.
struct ReachBox {
  Vec3 size = Vec3::Zero();
  double near = 0;
};
/// Every point of the box is within the arm's ranges.
bool reaches(const Geometry& geometry, const ReachBox& box);
/// Largest factor by which a box of these sizes can be scaled and still be reached, with its near face wherever it is best.
double largestScale(const Geometry& geometry, const Vec3& size);
/// The same for two arms that face each other, their axes `apart`, and a box in the middle.
double largestCommonScale(const Geometry& geometry, const Vec3& size, double apart);

/// Force [N] that motors of this torque give in every direction, beside carrying the arm (y up).
double forceInAllDirections(const Parameters& parameters, const Joints& q, double torque);
/// The least of it over a box.
double leastForce(const Parameters& parameters, const ReachBox& box, double torque);

}  // namespace presa::percro
