#include "framework/walls/wall_leader.h"

#include <algorithm>

namespace presa::walls {

void WallLeader::hear(const bus::WallDrawn& drawn, std::int64_t now_ns) {
  if (drawn.number != 0 && drawn.leader == frame_.leader && drawn.number > frame_.number) return;  // forged
  if (members_.size() >= kMost && !members_.contains(drawn.sender)) return;
  Member& member = members_[drawn.sender];
  member.wall = drawn.wall;
  member.heard_ns = now_ns;
  member.behind = false;
  if (drawn.leader != frame_.leader || drawn.number <= member.number) return;
  member.number = drawn.number;
  if (drawn.number != frame_.number) return;
  if (!state_known_) {
    state_ = drawn.state;
    state_known_ = true;
  } else if (drawn.state != state_ && !frame_differs_) {
    frame_differs_ = true;
    ++differing_;
  }
}

bool WallLeader::ready(std::int64_t now_ns) {
  for (auto& [sender, member] : members_) {
    if (member.behind || now_ns - member.heard_ns <= kPatience) continue;
    member.behind = true;
    ++left_behind_;
  }
  return std::ranges::all_of(
      members_, [this](const auto& entry) { return entry.second.behind || entry.second.number == frame_.number; });
}

const bus::WallFrame& WallLeader::next(std::uint64_t run, double time, const Pose& X_KHead, bool tracked,
                                       std::int64_t now_ns) {
  ++frame_.number;
  frame_.run = run;
  frame_.time = time;
  frame_.X_KHead = X_KHead;
  frame_.tracked = tracked;
  state_known_ = frame_differs_ = false;
  sent_ns_ = now_ns;
  return frame_;
}

const bus::WallFrame* WallLeader::again(std::int64_t now_ns) {
  if (frame_.number == 0 || now_ns - sent_ns_ < kRepeat) return nullptr;
  sent_ns_ = now_ns;
  return &frame_;
}

std::vector<std::string> WallLeader::present() const {
  std::vector<std::string> names;
  for (const auto& [sender, member] : members_)
    if (!member.behind) names.push_back(member.wall);
  std::ranges::sort(names);
  return names;
}

}  // namespace presa::walls
