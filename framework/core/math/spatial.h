#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>

/// Spatial quantities in monogram notation: quantity_FrameTarget_Expressed.
///   p_WB   position of B's origin measured from W [m]      R_WB, q_WB  rotation taking B-vectors to W-vectors
///   X_WB   pose (p_WB, q_WB)                               v_WB, w_WB  linear, angular velocity [m/s, rad/s]
///   f_B_W  force on B expressed in W [N]                   nhat_AB_W   unit normal from A into B
/// Frames: W world (right-handed, z up), B body, D device base, H haptic interface point, P proxy, C contact.
namespace presa {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
/// Unit quaternion without SIMD alignment, so that states are plain packed data.
using Quat = Eigen::Quaternion<double, Eigen::DontAlign>;

/// Rigid transform X_AB: maps coordinates in B to coordinates in A.
struct Pose {
  Vec3 p = Vec3::Zero();
  Quat q = Quat::Identity();

  Vec3 operator*(const Vec3& p_B) const { return p + q * p_B; }
  Pose operator*(const Pose& X_BC) const { return {p + q * X_BC.p, q * X_BC.q}; }
  /// Coordinates in B of the point given in A: X_AB^-1 * p_A.
  Vec3 inverseTimes(const Vec3& p_A) const { return q.conjugate() * (p_A - p); }
  Pose inverse() const { return {q.conjugate() * (-p), q.conjugate()}; }
};

/// Pose at fraction s in [0, 1] between two poses: straight line, shortest great arc.
inline Pose interpolate(const Pose& a, const Pose& b, double s) { return {a.p + s * (b.p - a.p), a.q.slerp(s, b.q)}; }

}  // namespace presa
