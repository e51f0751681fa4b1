#include "modules/dynamics_ode/haptic_rate/gentle_return.h"

#include <algorithm>

#include "modules/dynamics_ode/rotation.h"

namespace presa::ode {
namespace {

Quat quatOf(const Vec3& turn) {
  const double angle = turn.norm();
  return Quat(angle < 1e-12 ? Eigen::AngleAxisd::Identity() : Eigen::AngleAxisd(angle, turn / angle));
}

}  // namespace

GentleReturn::GentleReturn(const BodyMotion& from, const BodyMotion& to, double time)
    : begin_(time),
      p_(from.X_WB_end.p - to.X_WB_end.p),
      v_(from.v_WB - to.v_WB),
      turn_(turnBetween(to.X_WB_end.q, from.X_WB_end.q)),
      w_(from.w_WB - to.w_WB) {}

// Hermite's cubics: value 1 and slope 0, value 0 and slope 1 at the begin; both end at zero with slope zero.
BodyMotion GentleReturn::at(const BodyMotion& to, double time) const {
  const double s = std::clamp((time - begin_) / kTime, 0.0, 1.0), rest = 1 - s;
  const double value = (1 + 2 * s) * rest * rest, slope = s * rest * rest * kTime;
  const double value_rate = -6 * s * rest / kTime, slope_rate = rest * (1 - 3 * s);
  BodyMotion motion = to;
  motion.X_WB_end.p += value * p_ + slope * v_;
  motion.X_WB_end.q = quatOf(value * turn_ + slope * w_) * to.X_WB_end.q;
  motion.X_WB_begin = motion.X_WB_end;
  motion.v_WB += value_rate * p_ + slope_rate * v_;
  motion.w_WB += value_rate * turn_ + slope_rate * w_;
  return motion;
}

}  // namespace presa::ode
