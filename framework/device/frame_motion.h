#pragma once
#include "framework/core/math/spatial.h"

namespace presa {

/// Where a frame F is in a frame W, and how it moves: p_W = X_WF.p + scale R_WF p_F. Angles are the same in both,
/// lengths are not; the power of a wrench is the same if its force is scaled as lengths are: f_F = scale R_FW f_W, t_F
/// = R_FW t_W.
struct FrameMotion {
  Pose X_WF;                 ///< of the origin of F, and of its axes
  Vec3 v_WF = Vec3::Zero();  ///< of its origin [m/s]
  Vec3 w_WF = Vec3::Zero();  ///< [rad/s]
  double scale = 1;          ///< metres of W for one of F
  double growth = 0;         ///< rate of change of the scale [1/s]

  /// The point that is at p in F.
  Vec3 pointAt(const Vec3& p) const noexcept { return X_WF.p + X_WF.q * (scale * p); }
  /// Velocity of the point that is at p in F and moves there with v.
  Vec3 velocityAt(const Vec3& p, const Vec3& v) const noexcept {
    const Vec3 carried = v_WF + w_WF.cross(X_WF.q * (scale * p)) + X_WF.q * (scale * v);
    return growth == 0 ? carried : carried + X_WF.q * (growth * p);
  }
};

/// A frame in a frame that moves.
inline FrameMotion operator*(const FrameMotion& parent, const FrameMotion& child) noexcept {
  return {{parent.pointAt(child.X_WF.p), parent.X_WF.q * child.X_WF.q},
          parent.velocityAt(child.X_WF.p, child.v_WF),
          parent.w_WF + parent.X_WF.q * child.w_WF,
          parent.scale * child.scale,
          parent.growth * child.scale + parent.scale * child.growth};
}

}  // namespace presa
