#include "apps/common/grasp_turn.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "framework/device/frame_tree.h"
#include "framework/geometry/rotation_between.h"

namespace presa {
namespace {

double angleOf(const Quat& q) { return 2 * std::atan2(q.vec().norm(), std::abs(q.w())); }

std::string frameOf(const Rig& rig, const std::string& role) {
  const auto found = std::ranges::find(rig.devices, role, &DeviceBinding::role);
  return found == rig.devices.end() ? kWorldFrame : found->frame;
}

/// Whether the frame stands in the world, and not on a tool.
bool standsAlone(const Rig& rig, std::string frame) {
  while (frame != kWorldFrame) {
    const auto found = std::ranges::find(rig.frames, frame, &Frame::name);
    if (found == rig.frames.end()) return false;
    frame = found->parent;
  }
  return true;
}

bool touches(const FingerContact& finger, std::int32_t body) {
  return finger.mode != ContactMode::kNone && finger.body == body;
}

/// Line from finger to finger, and orientation of the object, in the frame of the devices.
struct Held {
  Vec3 line;
  Quat object;
};

}  // namespace

std::optional<GraspTurn> graspTurn(const World& world, std::span<const TraceSample> trace, double hold_begin,
                                   const TracedGrasp& grasp) {
  const std::string frame = frameOf(world.rig, world.scene.devices[grasp.first].role);
  if (frame != frameOf(world.rig, world.scene.devices[grasp.second].role)) return std::nullopt;
  if (!standsAlone(world.rig, frame)) return std::nullopt;
  const FrameTree frames(world.rig, world.scene.devices);
  const auto heldIn = [&](const TraceSample& sample) {
    const Quat q_FW = frames.at(frames.find(frame), sample.time).X_WF.q.conjugate();
    return Held{q_FW * (sample.fingers[grasp.second].p_WP - sample.fingers[grasp.first].p_WP),
                q_FW * sample.bodies[grasp.slot].q};
  };
  GraspTurn turn;
  std::optional<Held> begin;
  for (const TraceSample& sample : trace) {
    if (!touches(sample.fingers[grasp.first], grasp.body) || !touches(sample.fingers[grasp.second], grasp.body)) {
      if (sample.time < hold_begin) begin.reset();
      continue;
    }
    if (!begin) begin = heldIn(sample);
    if (sample.time < hold_begin) continue;
    const Held now = heldIn(sample);
    const Quat hand = rotationBetween(begin->line, now.line);
    turn.hand = std::max(turn.hand, angleOf(hand));
    turn.object = std::max(turn.object, angleOf(hand.conjugate() * now.object * begin->object.conjugate()));
    turn.sideways = std::max(turn.sideways, now.line.cross(begin->line.normalized()).norm() / 2);
  }
  return turn;
}

}  // namespace presa
