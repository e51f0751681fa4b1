#include "modules/view_osg/pointer_control.h"

#include <algorithm>
#include <cmath>

namespace presa::view {
namespace {

/// Minimum slope of the drag plane: in a plane seen almost edge-on the pair would run away from the mouse.
constexpr double kFlattest = 0.3;

}  // namespace

/// Middle between the fingers; none as long as one has no sample.
std::optional<Vec3> PointerControl::middle(const DeviceState& device) const {
  Vec3 sum = Vec3::Zero();
  for (const std::size_t f : fingers_) {
    if (f >= static_cast<std::size_t>(device.count()) || !device.fingers[f].valid) return std::nullopt;
    sum += device.fingers[f].p_WH;
  }
  return fingers_.empty() ? std::nullopt : std::optional<Vec3>(sum / static_cast<double>(fingers_.size()));
}

void PointerControl::begin(const DeviceState& device) {
  if (begun_) return;
  const std::optional<Vec3> start = middle(device);
  if (!start) return;
  stylus_ = device.fingers[fingers_.back()].oriented;
  state_.p_WT = *start;
  begun_ = true;
}

void PointerControl::heed(const DeviceState& device) {
  if (pressed_ > 0 && --pressed_ == 0) {
    state_.buttons = 0;
    changed();
  }
  const std::optional<Vec3> now = middle(device);
  if (!begun_ || !now) return;
  const double z = std::clamp(state_.p_WT.z(), now->z() - kLead, now->z() + kLead);
  if (z == state_.p_WT.z()) return;
  state_.p_WT.z() = z;
  changed();
}

void PointerControl::dragLevel(double right, double up, const CameraControl& camera) {
  const double scale = camera.scaleAt(state_.p_WT);
  move(scale * right, scale * up / std::max(kFlattest, std::sin(camera.elevation())), 0, camera);
}

void PointerControl::dragUpright(double right, double up, const CameraControl& camera) {
  const double scale = camera.scaleAt(state_.p_WT);
  move(scale * right, 0, scale * up / std::max(kFlattest, std::cos(camera.elevation())), camera);
}

void PointerControl::move(double right, double away, double up, const CameraControl& camera) {
  if (!begun_) return;
  const Vec3 right_W = camera.axes().right;
  state_.p_WT += right * right_W + away * Vec3::UnitZ().cross(right_W) + up * Vec3::UnitZ();
  changed();
}

void PointerControl::turn(double angle) {
  if (!begun_) return;
  state_.yaw += angle;
  changed();
}

void PointerControl::press() {
  if (!begun_) return;
  state_.buttons = 1U << kPickUpButton;
  pressed_ = kPressed;
  changed();
}

void PointerControl::close(double steps) {
  if (!begun_) return;
  state_.wheel += steps * kCloseStep;
  if (stylus_)
    state_.tilt = std::clamp(state_.tilt + steps * kTurnStep, -kMaxTilt, kMaxTilt);
  else
    state_.closing = std::clamp(state_.closing + steps * kCloseStep, 0.0, 1.0);
  changed();
}

}  // namespace presa::view
