#pragma once
#include "devices/percro_arm/parameters.h"
#include "framework/core/math/spatial.h"

/// Kinematics of one arm: two crossing axes and a barrel that slides through where they meet (RRP), driven through a
/// differential, and a passive wrist. Frame D of the base: origin where the axes meet; x along the barrel at rest, y up (the
/// paper's vertical), z the tilt axis. Thread: any; nothing here allocates or fails.
namespace presa::percro {

/// q1 tilt about z, q2 yaw about the tilted y [rad], q3 = L - length_min, how far the barrel is out [m].
using Joints = Vec3;

/// K: motor angles [rad] of joint values [Bergamasco2006 eq. 1]. Equal motor angles give yaw, opposite ones tilt.
Mat3 transmission(const Geometry& geometry);
/// K^-1, in closed form.
Mat3 transmissionInverse(const Geometry& geometry);

/// Turn of the barrel R_DB = Rz(q1) Ry(q2): its x axis is the line of the barrel.
Mat3 barrelFrame(const Joints& q);
/// Position of the tip [m, D]; [Bergamasco2006 eq. 2].
Vec3 tipPosition(const Geometry& geometry, const Joints& q);
/// dp/dq, a column per joint. [Bergamasco2006 eq. 3] with dx/dq2 = -L cos q1 sin q2, where the paper prints cos q2.
Mat3 jacobian(const Geometry& geometry, const Joints& q);

/// Joints that put the tip at a point: the only ones with L > 0 and |q2| <= 90 degrees. Within reach or not; at a
/// singularity q1, and at the centre q2, is 0.
Joints jointsAt(const Geometry& geometry, const Vec3& p_DT);
/// The joints keep within the arm's ranges.
bool withinReach(const Geometry& geometry, const Joints& q, double tolerance = 0);

/// Where a direction of motion is lost. Neither lies within the arm's reach.
enum class Singularity {
  kNone,
  kBarrelAlongTiltAxis,  ///< cos q2 = 0: the tip lies on z, q1 turns it on the spot
  kTipAtCentre           ///< L = 0: neither angle moves it
};
/// `tolerance`: of cos q2, and of L relative to its smallest.
Singularity singularityAt(const Geometry& geometry, const Joints& q, double tolerance = 1e-6);

/// Singular values of J K^-1 [m/rad], in the order tilt, yaw, barrel: its columns' frame makes them
/// L cos q2 / (sqrt 2 tau_1), L / (sqrt 2 tau_1 tau_2), r_b.
Vec3 gains(const Geometry& geometry, const Joints& q);
/// Largest over smallest of them [Bergamasco2006 fig. 2]; infinite at a singularity.
double conditionNumber(const Geometry& geometry, const Joints& q);
/// Farthest that the tip moves while each of the first two encoders stays within one count: L count / tau_1 [m].
double transverseStep(const Parameters& parameters, double length);
/// Step of the barrel [m].
double axialStep(const Parameters& parameters);

/// Passive wrist: roll about the barrel, pitch, yaw of the thimble [rad], about axes that meet in the tip; no motion or force
/// of the tip depends on it. The paper prints no notation: this order is a GUESS. Singular at a pitch of 90 degrees.
Mat3 thimbleFrame(const Joints& q, const Vec3& wrist);
/// Wrist angles of the thimble's turn R_DT, |pitch| <= 90 degrees. At the singularity yaw is 0.
Vec3 wristAt(const Joints& q, const Mat3& R_DT);

}  // namespace presa::percro
