#pragma once
#include "framework/core/math/spatial.h"

namespace presa::ode {

/// Free rotation of a rigid body over `h` [s]. Updates orientation q_WB and angular velocity w_WB [rad/s], given the
/// inertia about the centre of mass in body axes [kg m^2] and its inverse. Since angular momentum is constant, only
/// q_WB' = 1/2 w(q_WB) q_WB is integrated (classical Runge-Kutta, sub-steps of 1/40 rad) and w follows from it:
/// momentum is exact to rounding, energy to fifth order in h per step.
void driftRotation(Quat& q_WB, Vec3& w_WB, const Mat3& inertia, const Mat3& inverse_inertia, double h);

/// The same by a Magnus series of fourth order for the rotation vector, sub-steps of 1/20 rad: an error of the same order,
/// at a fifth of the cost. For islands with joints, which ask several times in a step.
void magnusRotation(Quat& q_WB, Vec3& w_WB, const Mat3& inertia, const Mat3& inverse_inertia, double h);

/// A body that turns freely, as above.
struct Turning {
  Quat& q_WB;
  Vec3& w_WB;
  const Mat3 &inertia, &inverse_inertia;
};
/// Of two bodies: the same bits as one after the other, in little more time than one takes.
void magnusRotations(const Turning& first, const Turning& second, double h);

/// One explicit Euler step of Euler's equations and of the quaternion, then normalised. Textbook baseline; gains
/// energy.
void eulerRotation(Quat& q_WB, Vec3& w_WB, const Mat3& inertia, const Mat3& inverse_inertia, double h);

/// R <- R (I + S(w_B) h), re-orthonormalised, with constant angular velocity in W; bodies with unequal moments never
/// tumble. (For body rates I + S h multiplies from the right.)
void matrixRotation(Quat& q_WB, const Vec3& w_WB, double h);

/// Rotation from `from` to `to` as a rotation vector in W, by the shorter way [rad].
Vec3 turnBetween(const Quat& from, const Quat& to);

}  // namespace presa::ode
