#include "framework/device/frame_tree.h"

#include <algorithm>

#include "framework/device/minimum_jerk.h"

namespace presa {
namespace {

FrameMotion between(const Frame::Key& from, const Frame::Key& to, double time) noexcept {
  const double span = to.time - from.time, s = (time - from.time) / span;
  const double done = minimumJerk(s), rate = minimumJerkSlope(s) / span;
  const Vec3 way = to.X_PF.p - from.X_PF.p;
  const Quat turn = to.X_PF.q.dot(from.X_PF.q) < 0 ? Quat(-to.X_PF.q.coeffs()) : to.X_PF.q;
  const Eigen::AngleAxisd angle(turn * from.X_PF.q.conjugate());
  return {{from.X_PF.p + done * way, Quat(Eigen::AngleAxisd(done * angle.angle(), angle.axis())) * from.X_PF.q},
          rate * way,
          rate * angle.angle() * angle.axis()};
}

/// Motion in the parent. A frame with keys rests at the first one before it, and at the last one after it.
FrameMotion inParent(const Frame& frame, double time) noexcept {
  const auto& keys = frame.keys;
  if (keys.empty()) return {.X_WF = frame.X_PF};
  const auto next = std::ranges::find_if(keys, [time](const Frame::Key& key) { return key.time > time; });
  if (next == keys.begin()) return {.X_WF = frame.X_PF * keys.front().X_PF};
  if (next == keys.end()) return {.X_WF = frame.X_PF * keys.back().X_PF};
  FrameMotion motion = between(*(next - 1), *next, time);
  return {frame.X_PF * motion.X_WF, frame.X_PF.q * motion.v_WF, frame.X_PF.q * motion.w_WF};
}

FrameMotion operator*(const FrameMotion& parent, const FrameMotion& child) noexcept {
  const Vec3 arm = parent.X_WF.q * child.X_WF.p;
  return {parent.X_WF * child.X_WF, parent.v_WF + parent.w_WF.cross(arm) + parent.X_WF.q * child.v_WF,
          parent.w_WF + parent.X_WF.q * child.w_WF};
}

}  // namespace

FrameTree::FrameTree(const Rig& rig, const std::vector<DeviceRole>& roles)
    : tools_(roles.size()), carries_(roles.size()) {
  for (const DeviceRole& role : roles) roles_.push_back(role.role);
  for (const Frame& frame : rig.frames) nodes_.push_back({frame, kWorld});
  for (Node& node : nodes_) node.parent = find(node.frame.parent);
  const auto stands = [&](int parent) {
    if (parent >= 0 && static_cast<std::size_t>(parent) < roles_.size()) carries_[static_cast<std::size_t>(parent)] = 1;
  };
  for (const Node& node : nodes_) stands(node.parent);
  for (const DeviceBinding& device : rig.devices) stands(find(device.frame));
}

int FrameTree::find(const std::string& name) const {
  const auto role = std::ranges::find(roles_, name);
  if (role != roles_.end()) return static_cast<int>(role - roles_.begin());
  const auto node =
      std::ranges::find(nodes_, name, [](const Node& one) -> const std::string& { return one.frame.name; });
  return node == nodes_.end() ? kWorld : static_cast<int>(roles_.size()) + static_cast<int>(node - nodes_.begin());
}

FrameMotion FrameTree::at(int frame, double time) const noexcept {
  if (frame == kWorld) return {};
  const auto index = static_cast<std::size_t>(frame);
  if (index < tools_.size()) return tools_[index];
  const Node& node = nodes_[index - tools_.size()];
  return at(node.parent, time) * inParent(node.frame, time);
}

}  // namespace presa
