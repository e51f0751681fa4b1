#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>

/// Spatial quantities in monogram notation: quantity_FrameTarget_Expressed.
///   p_WB   position of B's origin measured from W [m]      R_WB, q_WB  rotation taking B-vectors to W-vectors
///   X_WB   pose (p_WB, q_WB)                               v_WB, w_WB  linear, angular velocity [m/s, rad/s]
///   f_B_W  force on B expressed in W [N]                   t_B_W   torque on B about its origin [N m]
///   F_B_W  wrench on B: f_B_W and t_B_W                    nhat_AB_W   unit normal from A into B
/// Frames: W world (z up), B body, D device base, H haptic interface point, T tool (origin H), P proxy, C contact.
namespace presa {

using Vec3 = Eigen::Vector3d;  ///< a vector or a point, in the frame of its name
using Mat3 = Eigen::Matrix3d;  ///< 3 x 3, such as an inertia
/// Unit quaternion without SIMD alignment, so that states are plain packed data.
using Quat = Eigen::Quaternion<double, Eigen::DontAlign>;

/// A force [N] and a torque about the origin of the frame on which it acts [N m]. A force alone converts to a wrench.
struct Wrench {
  Vec3 f,  ///< force [N]
      t;   ///< torque [N m]
  Wrench(const Vec3& force = Vec3::Zero(), const Vec3& torque = Vec3::Zero()) : f(force), t(torque) {}  ///< [N], [N m]
  bool operator==(const Wrench&) const = default;  ///< exact, component by component
};

/// Rigid transform X_AB: maps coordinates in B to coordinates in A.
struct Pose {
  Vec3 p = Vec3::Zero();      ///< of B's origin in A [m]
  Quat q = Quat::Identity();  ///< takes B-vectors to A-vectors; unit length

  Vec3 operator*(const Vec3& p_B) const { return p + q * p_B; }                    ///< p_A = X_AB * p_B [m]
  Pose operator*(const Pose& X_BC) const { return {p + q * X_BC.p, q * X_BC.q}; }  ///< X_AC = X_AB * X_BC
  /// Coordinates in B of the point given in A: X_AB^-1 * p_A.
  Vec3 inverseTimes(const Vec3& p_A) const { return q.conjugate() * (p_A - p); }
  Pose inverse() const { return {q.conjugate() * (-p), q.conjugate()}; }  ///< X_BA
};

/// Pose at fraction s in [0, 1] between two poses: straight line, shortest great arc.
inline Pose interpolate(const Pose& a, const Pose& b, double s) { return {a.p + s * (b.p - a.p), a.q.slerp(s, b.q)}; }

}  // namespace presa
