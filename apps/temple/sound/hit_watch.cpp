#include "apps/temple/sound/hit_watch.h"

#include <cmath>
#include <utility>

namespace presa::temple {
namespace {

constexpr double kLongestGap = 0.05;    // between two states that are compared [s]
constexpr std::size_t kMostHits = 256;  // that wait to be taken

}  // namespace

HitWatch::HitWatch(std::shared_ptr<const World> world, double density, double full_size)
    : Module("hit_watch", RateGroup::kView) {
  for (const Body& body : world->scene.bodies) {
    const double mass = body.fixed ? 0 : body.mass.value_or(0);
    stones_.push_back({.length = mass > 0 ? full_size * std::cbrt(mass / density) : 0});
  }
  hits_.reserve(kMostHits);
}

void HitWatch::step(const Tick&) noexcept {
  if (!objects_.hasValue()) return;
  const ObjectState& now = objects_.value();
  const double gap = now.time_end - seen_;
  if (!(gap > 0)) return;
  const bool comparable = seen_ >= 0 && gap < kLongestGap;
  seen_ = now.time_end;
  const std::lock_guard lock(mutex_);
  for (std::size_t i = 0; i < stones_.size() && i < now.bodies.size(); ++i) {
    Stone& stone = stones_[i];
    const double before = std::exchange(stone.speed, now.bodies[i].v_WB.norm()), loss = before - stone.speed;
    if (stone.length <= 0 || !comparable || loss < kLoss || seen_ < stone.heard + kPause) continue;
    stone.heard = seen_;
    if (hits_.size() < kMostHits) hits_.push_back({seen_, loss, stone.length});
  }
}

std::vector<Hit> HitWatch::take() {
  const std::lock_guard lock(mutex_);
  std::vector<Hit> taken(hits_.begin(), hits_.end());
  hits_.clear();
  return taken;
}

}  // namespace presa::temple
