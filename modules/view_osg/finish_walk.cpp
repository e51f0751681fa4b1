#include "modules/view_osg/finish_walk.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace presa::view {

CameraPose FinishWalk::at(double seconds, unsigned touches, const CameraPose& pose, const Vec3& middle) {
  if (seconds < 0) {
    *this = {};
    return pose;
  }
  if (!std::exchange(begun_, true)) touches_ = touches;
  stopped_ = stopped_ || touches != touches_;
  if (!stopped_) {
    const double t = std::clamp((seconds - kPause) / kLap, 0.0, 1.0);
    angle_ = 2 * std::numbers::pi * t * t * (3 - 2 * t);
    walks_ = t > 0 && t < 1;
  } else {
    walks_ = false;
  }
  const auto turned = [&](const Vec3& p) {
    const Vec3 d = p - middle;
    const double c = std::cos(angle_), s = std::sin(angle_);
    return Vec3(middle.x() + c * d.x() - s * d.y(), middle.y() + s * d.x() + c * d.y(), p.z());
  };
  return {turned(pose.eye), turned(pose.target)};
}

}  // namespace presa::view
