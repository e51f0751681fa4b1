#include "framework/walls/wall_follower.h"

#include <cmath>

namespace presa::walls {
namespace {

bool isSound(const bus::WallFrame& frame) {
  constexpr double kRounding = 1e-6;  // of a unit quaternion
  return frame.leader != 0 && frame.number != 0 && std::isfinite(frame.time) && frame.X_KHead.p.allFinite() &&
         std::abs(frame.X_KHead.q.norm() - 1) < kRounding;
}

}  // namespace

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
