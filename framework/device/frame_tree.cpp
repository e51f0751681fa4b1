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

/// Motion by keys: a frame rests at the first one before it, and at the last one after it.
FrameMotion byKeys(const Frame& frame, double time) noexcept {
  const auto& keys = frame.keys;
  if (keys.empty()) return {.X_WF = frame.X_PF};
  const auto next = std::ranges::find_if(keys, [time](const Frame::Key& key) { return key.time > time; });
  if (next == keys.begin()) return {.X_WF = frame.X_PF * keys.front().X_PF};
  if (next == keys.end()) return {.X_WF = frame.X_PF * keys.back().X_PF};
  FrameMotion motion = between(*(next - 1), *next, time);
  return {frame.X_PF * motion.X_WF, frame.X_PF.q * motion.v_WF, frame.X_PF.q * motion.w_WF};
}

bool pressed(const std::optional<Frame::Button>& button, std::uint32_t buttons) noexcept {
  return button && button->number && ((buttons >> *button->number) & 1U) != 0;
}

}  // namespace

FrameTree::FrameTree(const Rig& rig, const std::vector<DeviceRole>& roles)
    : tools_(roles.size()), carries_(roles.size()), stands_(roles.size(), kWorld), seats_(roles.size()) {
  for (const DeviceRole& role : roles) roles_.push_back(role.role);
  for (const Frame& frame : rig.frames) {
    nodes_.push_back({frame, kWorld, {}});
    if (frame.driven()) nodes_.back().drive.emplace(frame);
  }
  for (Node& node : nodes_) node.parent = find(node.frame.parent);
  const auto stands = [&](int parent) {
    if (parent >= 0 && static_cast<std::size_t>(parent) < roles_.size()) carries_[static_cast<std::size_t>(parent)] = 1;
  };
  for (const Node& node : nodes_) stands(node.parent);
  for (const DeviceBinding& device : rig.devices) {
    stands(find(device.frame));
    const auto role = std::ranges::find(roles_, device.role);
    if (role != roles_.end()) stands_[static_cast<std::size_t>(role - roles_.begin())] = find(device.frame);
  }
  for (std::size_t role = 0; role < roles_.size(); ++role) seat(role, stands_[role]);
}

/// Notes the device in every driven frame that it is in, also through the tools of others.
void FrameTree::seat(std::size_t role, int frame) {
  int at = frame;
  while (at != kWorld) {
    const auto index = static_cast<std::size_t>(at);
    if (index < roles_.size()) {
      at = stands_[index];
      continue;
    }
    Node& node = nodes_[index - roles_.size()];
    if (node.drive) {
      seats_[role].push_back({index - roles_.size(), node.drive->seats.size()});
      node.drive->seats.emplace_back();
      node.drive->seats.back().role = role;
      node.drive->seats.back().frame = frame;
    }
    at = node.parent;
  }
}

int FrameTree::find(const std::string& name) const {
  const auto role = std::ranges::find(roles_, name);
  if (role != roles_.end()) return static_cast<int>(role - roles_.begin());
  const auto node =
      std::ranges::find(nodes_, name, [](const Node& one) -> const std::string& { return one.frame.name; });
  return node == nodes_.end() ? kWorld : static_cast<int>(roles_.size()) + static_cast<int>(node - nodes_.begin());
}

FrameMotion FrameTree::inParent(const Node& node, double time) const noexcept {
  const FrameMotion motion = byKeys(node.frame, time);
  return node.drive ? motion * node.drive->motion.motion() : motion;
}

FrameMotion FrameTree::at(int frame, double time) const noexcept {
  if (frame == kWorld) return {};
  const auto index = static_cast<std::size_t>(frame);
  if (index < tools_.size()) return tools_[index].motion();
  const Node& node = nodes_[index - tools_.size()];
  return at(node.parent, time) * inParent(node, time);
}

bool FrameTree::known(int frame) const noexcept {
  if (frame == kWorld) return true;
  const auto index = static_cast<std::size_t>(frame);
  return index < tools_.size() ? tools_[index].known() : known(nodes_[index - tools_.size()].parent);
}

/// Motion of a frame in a node above it; none if a tool is between them.
std::optional<FrameMotion> FrameTree::within(int frame, std::size_t node, double time) const noexcept {
  if (frame == kWorld || static_cast<std::size_t>(frame) < tools_.size()) return std::nullopt;
  const std::size_t index = static_cast<std::size_t>(frame) - tools_.size();
  if (index == node) return FrameMotion{};
  const auto parent = within(nodes_[index].parent, node, time);
  return parent ? std::optional(*parent * inParent(nodes_[index], time)) : std::nullopt;
}

std::optional<FrameDrive::Hand> FrameTree::middle(std::size_t node, double time) const noexcept {
  FrameDrive::Hand sum;
  double count = 0;
  for (const Seat& seat : nodes_[node].drive->seats) {
    const auto motion = within(seat.frame, node, time);
    if (!motion) continue;
    sum.p += motion->pointAt(seat.hand.p);
    sum.v += motion->velocityAt(seat.hand.p, seat.hand.v);
    ++count;
  }
  if (count == 0) return std::nullopt;
  return FrameDrive::Hand{sum.p / count, sum.v / count};
}

FrameWish FrameTree::wishFor(const Node& node) const noexcept {
  std::uint32_t buttons = 0;
  for (const Seat& seat : node.drive->seats) buttons |= seat.buttons;
  FrameWish wish = wish_;
  wish.clutch = wish.clutch || pressed(node.frame.clutch, buttons);
  if (!node.frame.zoom) return wish;
  wish.zoom += pressed(node.frame.zoom->out, buttons) ? 1 : 0;
  wish.zoom -= pressed(node.frame.zoom->in, buttons) ? 1 : 0;
  wish.zoom = std::clamp(wish.zoom, -1.0, 1.0);
  return wish;
}

void FrameTree::sampled(std::size_t role, const FingerInput& sample, const Tick& tick) noexcept {
  for (const SeatOf& place : seats_[role]) {
    Seat& seat = nodes_[place.node].drive->seats[place.seat];
    const FingerInput checked = seat.check.take(sample, tick.period);
    seat.valid = checked.valid;
    seat.seen = seat.seen || checked.valid;
    if (checked.valid) seat.hand = {checked.p_WH, checked.v_WH};
    seat.buttons = checked.buttons;
  }
  for (const SeatOf& place : seats_[role]) step(place.node, tick);
}

void FrameTree::step(std::size_t index, const Tick& tick) noexcept {
  Drive& drive = *nodes_[index].drive;
  if (tick.index < drive.next_tick) return;
  if (!std::ranges::all_of(drive.seats, &Seat::seen)) return;
  drive.next_tick = tick.index + 1;
  FrameDrive::Touch touch;
  for (Seat& seat : drive.seats) {
    touch.written = touch.written && seat.written;
    touch.felt = touch.felt || seat.felt || seat.doubted || !seat.valid;
  }
  if (touch.written)
    for (Seat& seat : drive.seats) seat.written = false;
  drive.motion.step(wishFor(nodes_[index]), middle(index, tick.time), touch, tick.period);
}

void FrameTree::doubt(std::size_t role, bool doubted) noexcept {
  for (const SeatOf& place : seats_[role]) nodes_[place.node].drive->seats[place.seat].doubted = doubted;
}

void FrameTree::rearm(std::size_t role) noexcept {
  for (const SeatOf& place : seats_[role]) nodes_[place.node].drive->seats[place.seat].check.rearm();
}

bool FrameTree::withholds(std::size_t role, bool felt) noexcept {
  bool withheld = false;
  for (const SeatOf& place : seats_[role]) {
    Drive& drive = *nodes_[place.node].drive;
    drive.seats[place.seat].written = true;
    drive.seats[place.seat].felt = felt;
    withheld = withheld || (felt && drive.motion.changed());
  }
  return withheld;
}

void FrameTree::tell(double time, FrameState& state) const noexcept {
  state.time = time;
  for (std::size_t n = 0; n < nodes_.size() && n < state.frames.size(); ++n) {
    const FrameMotion motion = at(static_cast<int>(tools_.size() + n), time);
    FrameNow& now = state.frames[n];
    now = nodes_[n].drive ? nodes_[n].drive->motion.now() : FrameNow();
    if (const auto tool = static_cast<std::size_t>(nodes_[n].parent);
        nodes_[n].parent != kWorld && tool < tools_.size()) {
      now.doing |= (tools_[tool].lost() ? kFrameLost : 0U) | (tools_[tool].returns() ? kFrameReturns : 0U);
      now.losses = tools_[tool].losses();
    }
    now.X_WF = motion.X_WF;
    now.zoom = motion.scale;
  }
}

ZoomRange zoomRange(const Rig& rig, const std::string& role) {
  ZoomRange range;
  const auto device = std::ranges::find(rig.devices, role, &DeviceBinding::role);
  std::string at = device == rig.devices.end() ? kWorldFrame : device->frame;
  while (at != kWorldFrame) {
    const auto frame = std::ranges::find(rig.frames, at, &Frame::name);
    if (frame == rig.frames.end()) break;  // a tool: it has a pose, and no scale
    if (frame->zoom) {
      range.min *= frame->zoom->min;
      range.max *= frame->zoom->max;
    }
    at = frame->parent;
  }
  return range;
}

}  // namespace presa
