#include "modules/view_osg/camera_control.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/scene/picture_options.h"

namespace presa::view {
namespace {

constexpr double kTurn = 1.6;  // rotation for a drag over half of the picture's height [rad]
constexpr double kNearest = kCameraNearest, kFarthest = kCameraFarthest;
const double kSlope = std::tan(kFieldOfView / 2 * std::numbers::pi / 180);

}  // namespace

void CameraControl::set(const CameraPose& pose) {
  const Vec3 out = pose.eye - pose.target;
  target_ = pose.target;
  distance_ = std::clamp(out.norm(), kNearest, kFarthest);
  const bool vertical = std::hypot(out.x(), out.y()) < 1e-6 * distance_;
  heading_ = vertical ? 0 : std::atan2(out.x(), -out.y());  // +y is upwards in a picture from above
  elevation_ = std::clamp(std::asin(std::clamp(out.z() / distance_, -1.0, 1.0)), -kSteepest, kSteepest);
  stayAbove();
}

void CameraControl::orbit(double right, double up) {
  heading_ -= kTurn * right;
  elevation_ = std::clamp(elevation_ - kTurn * up, -kSteepest, kSteepest);
  stayAbove();
}

void CameraControl::stayAbove() {
  if (!ground_) return;
  const double lowest = *ground_ + kAboveGround;
  target_.z() = std::max({target_.z(), *ground_, lowest - 0.99 * distance_});
  elevation_ = std::max(elevation_, std::asin(std::clamp((lowest - target_.z()) / distance_, -1.0, 1.0)));
  elevation_ = std::clamp(elevation_, -kSteepest, kSteepest);
}

void CameraControl::pan(double right, double up) {
  target_ -= distance_ * kSlope * (right * axes().right + up * axes().up);
  stayAbove();
}

void CameraControl::zoom(double factor) {
  distance_ = std::clamp(distance_ * factor, kNearest, kFarthest);
  stayAbove();
}

void CameraControl::fly(double right, double ahead, double up) {
  const CameraAxes now = axes();
  target_ += distance_ * (right * now.right + ahead * Vec3::UnitZ().cross(now.right) + up * Vec3::UnitZ());
  stayAbove();
}

CameraPose CameraControl::pose() const { return {target_ - distance_ * axes().forward, target_}; }

double CameraControl::scaleAt(const Vec3& p_W) const {
  return kSlope * std::max(kNearest, (p_W - pose().eye).dot(axes().forward));
}

Vec3 CameraControl::rayThrough(double right, double up) const {
  const CameraAxes now = axes();
  return (now.forward + kSlope * (aspect_ * right * now.right + up * now.up)).normalized();
}

}  // namespace presa::view
