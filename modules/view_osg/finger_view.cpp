#include "modules/view_osg/finger_view.h"

#include <algorithm>

namespace presa::view {

bool FingerView::isPushed() const noexcept {
  const double length = kArrowLengthPerNewton * f_H_W.norm();
  return valid && length > 1e-4 && length < kLongestArrow;
}

double FingerView::frictionUse() const noexcept {
  const double bound = friction * normal_force;
  return bound > 0 ? tangential_force / bound : 0.0;
}

namespace {

void placeContact(const FingerContact& contact, const std::vector<Pose>& X_WB, FingerView& finger) {
  finger.p_WH = contact.p_WH;
  finger.p_WP = contact.p_WP;
  finger.t_H_W = contact.t_H_W;
  finger.f_H_W = contact.f_H_W;  // effects of the scene push without contact, too
  const auto body = static_cast<std::size_t>(contact.body);
  if (contact.mode == ContactMode::kNone || contact.body == kNoBody || body >= X_WB.size()) return;
  finger.mode = contact.mode;
  finger.body = contact.body;
  finger.p_WP = X_WB[body] * contact.p_BP;
  finger.p_WC = X_WB[body] * contact.p_BC;
  finger.nhat_W = X_WB[body].q * contact.nhat_B;
  finger.normal_force = contact.normal_force;
  finger.tangential_force = contact.tangential_force_W.norm();
  finger.friction_static = contact.friction_static;
  finger.friction = contact.mode == ContactMode::kSlip ? contact.friction_dynamic : contact.friction_static;
}

// Where nobody says how the body holds a tool, it is turned as its handle.
void placeTool(const World& world, const ViewFrame& frame, std::size_t i, FingerView& finger) {
  if (i >= world.tools.size() || !world.tools[i]) return;
  const bool known = frame.tools != nullptr && i < frame.tools->tools.size() && frame.tools->tools[i].alive;
  finger.has_volume = true;
  finger.friction = finger.friction_static = 0;  // it touches on many sides: no cone around a common normal
  finger.radius = radiusOf(*world.tools[i]);
  const Pose X_WH{finger.p_WH, finger.q_WT};
  finger.X_WT = known ? frame.tools->tools[i].X_WT : Pose{finger.p_WP, finger.q_WT};
  finger.X_WT_wanted = known ? X_WH * frame.tools->tools[i].X_HT : X_WH;
  finger.lies = known && frame.tools->tools[i].lies;
}

}  // namespace

std::vector<FingerView> fingerViews(const World& world, const ViewFrame& frame) {
  const auto& roles = world.scene.devices;
  std::vector<FingerView> fingers(roles.size());
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    FingerView& finger = fingers[i];
    const auto index = static_cast<std::int32_t>(i);
    finger.role = roles[i].role;
    finger.radius = roles[i].fingertip_radius;
    finger.force_limit = roles[i].limits.force;
    if (index < frame.device.count()) {
      finger.valid = frame.device.fingers[i].valid;
      finger.p_WH = finger.p_WP = frame.device.fingers[i].p_WH;
      finger.oriented = frame.device.fingers[i].oriented;
      finger.q_WT = frame.device.fingers[i].q_WT;
    }
    if (index < frame.contacts.count()) placeContact(frame.contacts.fingers[i], frame.X_WB, finger);
    placeTool(world, frame, i, finger);
    if (index < frame.forces.count() && finger.touches())
      finger.commanded_normal = std::max(0.0, frame.forces.f_H_W[i].dot(finger.nhat_W));
  }
  return fingers;
}

std::vector<FingerView> withoutMeasured(std::vector<FingerView> fingers) {
  for (FingerView& finger : fingers) {
    finger.mode = ContactMode::kNone;
    finger.body = kNoBody;
    finger.p_WH = finger.p_WC = finger.p_WP;
    finger.nhat_W = Vec3::UnitZ();
    finger.f_H_W = Vec3::Zero();
    finger.normal_force = finger.commanded_normal = finger.tangential_force = finger.friction = finger.friction_static =
        0;
  }
  return fingers;
}

double gripForce(const std::vector<FingerView>& fingers) {
  double grip = 0;
  for (const FingerView& first : fingers) {
    if (!first.touches()) continue;
    double pressed = 0;
    Vec3 net = Vec3::Zero();
    for (const FingerView& finger : fingers) {
      if (finger.body != first.body || !finger.touches()) continue;
      pressed += finger.commanded_normal;
      net += finger.commanded_normal * finger.nhat_W;
    }
    grip = std::max(grip, (pressed - net.norm()) / 2);
  }
  return grip;
}

double maxGripForce(const std::vector<DeviceRole>& roles) {
  double sum = 0, strongest = 0;
  for (const DeviceRole& role : roles) {
    sum += role.limits.force;
    strongest = std::max(strongest, role.limits.force);
  }
  return std::min(sum / 2, sum - strongest);
}

}  // namespace presa::view
