#include "framework/walls/wall_leader.h"

#include <algorithm>

#include "framework/walls/sound.h"

namespace presa::walls {

bool WallLeader::hear(const bus::WallDrawn& drawn, std::int64_t now_ns) {
  const bool mine = drawn.leader == frame_.leader;
  if (!isSound(drawn) || (mine && drawn.number > frame_.number)) return false;  // damaged or forged
  if (!members_.contains(drawn.sender) && !makeRoom()) return false;
  Member& member = members_[drawn.sender];
  const bool draws = mine && drawn.number > member.number;
  member.wall = drawn.wall;
  member.heard_ns = now_ns;
  if (member.behind && (draws || !member.idle)) {
    member.behind = member.idle = false;
    member.since_ns = now_ns;
  }
  if (!draws) return true;
  member.number = drawn.number;
  if (drawn.number == frame_.number) compare(drawn.state);
  return true;
}

// Processes that have ended stay in the list, as they may only be silent, until others need their places.
bool WallLeader::makeRoom() {
  if (members_.size() < kMost) return true;
  const auto behind = std::ranges::find_if(members_, [](const auto& entry) { return entry.second.behind; });
  if (behind == members_.end()) return false;
  members_.erase(behind);
  return true;
}

void WallLeader::compare(std::uint64_t state) {
  if (!state_known_) {
    state_ = state;
    state_known_ = true;
  } else if (state != state_ && !frame_differs_) {
    frame_differs_ = true;
    ++differing_;
  }
}

bool WallLeader::ready(std::int64_t now_ns) {
  for (auto& [sender, member] : members_) {
    const bool silent = now_ns - member.heard_ns > kPatience;
    const bool waited = now_ns - std::max(announced_ns_, member.since_ns) > kPatience;
    if (member.behind || !(silent || (waited && member.number != frame_.number))) continue;
    member.behind = true;
    member.idle = !silent;
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
  const bool sound = isSound(X_KHead);  // walls ignore a frame without a head, so all of them would stop
  if (sound) frame_.X_KHead = X_KHead;
  frame_.tracked = tracked && sound;
  state_known_ = frame_differs_ = false;
  announced_ns_ = sent_ns_ = now_ns;
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
