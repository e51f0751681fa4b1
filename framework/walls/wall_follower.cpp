#include "framework/walls/wall_follower.h"

#include "framework/walls/sound.h"

namespace presa::walls {

WallFollower::WallFollower(std::uint64_t sender, const std::string& wall, const Pose& rest) {
  said_.sender = sender;
  said_.wall = wall;
  said_.X_KHead = rest;
}

void WallFollower::hear(const bus::WallFrame& frame, std::int64_t now_ns) {
  if (!isSound(frame)) return;
  const bool other = frame.leader != frame_.leader;
  if (other && led() && !leaderLost(now_ns)) return;
  heard_ns_ = now_ns;
  if (other) said_.number = 0;
  if (other || frame.number > frame_.number) frame_ = frame;
}

const bus::WallDrawn& WallFollower::drawn(std::uint64_t state, std::int64_t now_ns) {
  said_.leader = frame_.leader;
  said_.number = frame_.number;
  said_.time = frame_.time;
  said_.state = state;
  said_.X_KHead = frame_.X_KHead;
  said_.shown_ns = said_ns_ = now_ns;
  return said_;
}

const bus::WallDrawn* WallFollower::again(std::int64_t now_ns) {
  if (now_ns - said_ns_ < kGreeting) return nullptr;
  said_ns_ = now_ns;
  return &said_;
}

}  // namespace presa::walls
