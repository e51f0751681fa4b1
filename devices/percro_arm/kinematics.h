#pragma once
#include "devices/percro_arm/parameters.h"
#include "framework/core/math/spatial.h"

/// Kinematics of one arm: two intersecting axes and a barrel that slides through their intersection (RRP), driven
/// through a differential, with a passive wrist. Frame D of the base: origin at the intersection; x along the barrel at
/// rest, y up (the paper's vertical), z the tilt axis. Thread: any; nothing here allocates or fails.
namespace presa::percro {

/// q1 tilt about z, q2 yaw about the tilted y [rad], q3 = L - length_min, extension of the barrel [m].
using Joints = Vec3;

/// K: motor angles [rad] from joint values [Bergamasco2006 eq. 1]. Equal motor angles give yaw, opposite ones tilt.
Mat3 transmission(const Geometry& geometry);
/// K^-1, in closed form.
Mat3 transmissionInverse(const Geometry& geometry);

/// Orientation of the barrel, R_DB = Rz(q1) Ry(q2); its x axis is the axis of the barrel.
Mat3 barrelFrame(const Joints& q);
/// Position of the tip [m, D]; [Bergamasco2006 eq. 2].
Vec3 tipPosition(const Geometry& geometry, const Joints& q);
/// dp/dq, one column per joint. [Bergamasco2006 eq. 3] with dx/dq2 = -L cos q1 sin q2, where the paper prints cos q2.
Mat3 jacobian(const Geometry& geometry, const Joints& q);

/// Inverse kinematics: the unique joints with L > 0 and |q2| <= 90 degrees, within the ranges or not. At a singularity
/// q1 is 0; at the centre q2 is 0 too.
Joints jointsAt(const Geometry& geometry, const Vec3& p_DT);
/// True when the joints are within the arm's ranges.
bool withinReach(const Geometry& geometry, const Joints& q, double tolerance = 0);

/// A configuration that loses a direction of motion. Neither is within the arm's reach.
enum class Singularity {
  kNone,
  kBarrelAlongTiltAxis,  ///< cos q2 = 0: the tip lies on the z axis, and q1 does not move it
  kTipAtCentre           ///< L = 0: neither angle moves the tip
};
/// `tolerance`: on cos q2, and on L relative to its min.
Singularity singularityAt(const Geometry& geometry, const Joints& q, double tolerance = 1e-6);

/// Singular values of J K^-1 [m/rad], in the order tilt, yaw, barrel. In closed form they are L cos q2 / (sqrt 2
/// tau_1), L / (sqrt 2 tau_1 tau_2), r_b.
Vec3 gains(const Geometry& geometry, const Joints& q);
/// Ratio of the largest to the smallest gain [Bergamasco2006 fig. 2]; infinite at a singularity.
double conditionNumber(const Geometry& geometry, const Joints& q);
/// Max motion of the tip while each of the first two encoders stays within one count: L count / tau_1 [m].
double transverseStep(const Parameters& parameters, double length);
/// Position step of the barrel [m].
double axialStep(const Parameters& parameters);

/// Passive wrist: roll about the barrel, pitch and yaw of the thimble [rad], about axes that intersect in the tip; the
/// motion and force of the tip do not depend on it. The order is a GUESS, since the paper gives no notation. Singular
/// at a pitch of 90 degrees.
Mat3 thimbleFrame(const Joints& q, const Vec3& wrist);
/// Wrist angles from the thimble's orientation R_DT, |pitch| <= 90 degrees. At the singularity yaw is 0.
Vec3 wristAt(const Joints& q, const Mat3& R_DT);

}  // namespace presa::percro
