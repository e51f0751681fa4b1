#pragma once
#include "framework/core/math/spatial.h"
#include "framework/scene/joints/joint.h"

namespace presa::ode {

/// q * v to the bit, without the call that Eigen makes of it: a step of a joint turns many vectors.
inline Vec3 rotated(const Quat& q, const Vec3& v) {
  const double x = q.x(), y = q.y(), z = q.z(), w = q.w();
  const double across_x = y * v.z() - z * v.y(), across_y = z * v.x() - x * v.z(), across_z = x * v.y() - y * v.x();
  const double twice_x = across_x + across_x, twice_y = across_y + across_y, twice_z = across_z + across_z;
  return {v.x() + w * twice_x + (y * twice_z - z * twice_y), v.y() + w * twice_y + (z * twice_x - x * twice_z),
          v.z() + w * twice_z + (x * twice_y - y * twice_x)};
}

/// presa::poseOf() to the bit.
inline JointPose jointPoseOf(const JointFrames& frames, const Pose& X_WB, const Pose& X_WA) {
  const Vec3 p_in_B = X_WB.p + rotated(X_WB.q, frames.X_BJ.p), p_in_A = X_WA.p + rotated(X_WA.q, frames.X_AJ.p);
  const Quat back = (X_WA.q * frames.X_AJ.q).conjugate();
  return {rotated(back, p_in_B - p_in_A), back * (X_WB.q * frames.X_BJ.q)};
}

}  // namespace presa::ode
