#pragma once
#include "framework/math/spatial.h"

namespace presa {

/// How far around a finger the local geometry must be complete, so that the haptic loop finds every triangle it can
/// touch until the next patch arrives. Too small: the proxy waits at the border of its patch (ContactExchange::
/// coverage_lost). Too large: more triangles than a patch can hold, and the patch is cut short.
namespace reach {

/// Allowance for what the finger's and the body's speed may gain during the horizon [m/s^2]. A grasping hand stays
/// below 10, a dropped object adds 9.81. Larger values grow the radius by 0.3 mm per m/s^2.
inline constexpr double kAcceleration = 20;
/// What neither speed nor curvature explains: interpolation of poses, chord of rotation over the horizon [m].
inline constexpr double kMargin = 0.5e-3;
/// A patch is made from a pose at the start of a collision period, is published at latest at its end, and serves until
/// the next one is [collision periods].
inline constexpr double kCollisionPeriods = 2;
/// Object State may lag by one dynamics step [dynamics periods].
inline constexpr double kDynamicsPeriods = 1;

}  // namespace reach

/// Motion of the finger as seen from the body, at one instant.
struct RelativeMotion {
  Vec3 p_BoH_W = Vec3::Zero();  ///< finger from the body's origin [m]
  Vec3 v_WH = Vec3::Zero();     ///< [m/s]
  Vec3 v_WB = Vec3::Zero();     ///< [m/s]
  Vec3 w_WB = Vec3::Zero();     ///< [rad/s]
};

/// Largest way the finger can go in body coordinates within `horizon` seconds [m]: its speed against the point of the
/// (rotating) body where it is, and half an acceleration times time squared, where the acceleration is kAcceleration
/// plus the centripetal and Coriolis terms of the rotating frame.
double motionBound(const RelativeMotion& motion, double horizon);

}  // namespace presa
