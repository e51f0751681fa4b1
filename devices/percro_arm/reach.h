#pragma once
#include "devices/percro_arm/kinematics.h"

/// Reach of an arm, and its force there. Thread: any.
namespace presa::percro {

/// Distance between the axes of two arms that face each other in the shipped rig [m].
inline constexpr double kArmsApart = 1.5;

/// A box with faces along D's axes: sizes along x, y, z [m], near face at x = near, centred on the x axis.
struct ReachBox {
  Vec3 size = Vec3::Zero();
  double near = 0;
};
/// True when every point of the box is within the arm's ranges.
bool reaches(const Geometry& geometry, const ReachBox& box);
/// Max factor by which a box of these sizes can be scaled and still be reached, with its near face at the best
/// distance.
double largestScale(const Geometry& geometry, const Vec3& size);
/// Same for two facing arms with their axes `apart` [m], and a box centred between them.
double largestCommonScale(const Geometry& geometry, const Vec3& size, double apart);

/// Force [N] that motors of this torque produce in every direction, while they also carry the arm (y up).
double forceInAllDirections(const Parameters& parameters, const Joints& q, double torque);
/// Its min over a box [N].
double minForce(const Parameters& parameters, const ReachBox& box, double torque);

}  // namespace presa::percro
