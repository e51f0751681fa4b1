#include "apps/common/pacer.h"

namespace presa {
namespace {

constexpr std::int64_t kFrame = 16'000'000;    // [ns] between pictures of a paused run
constexpr std::int64_t kBehind = 200'000'000;  // [ns] longest delay that is caught up
constexpr std::int64_t kShown = 240'000'000;   // [ns] longest time without a picture of a late run, and a step

}  // namespace

void Pacer::step(const Tick& tick) noexcept {
  while (!due(tick.time)) {
    if (control_.stop_requested.load(std::memory_order_relaxed)) return;
    const std::int64_t next = clock_.now() + kFrame;
    if (meanwhile_) meanwhile_(tick.time);
    if (view_ != nullptr) {
      if (view_->wantsStop()) return;
      view_->refresh();
    }
    if (time_control_.paused) clock_.sleep_until(next);
  }
  choosePicture();
}

void Pacer::choosePicture() noexcept {
  const std::int64_t now = clock_.now();
  const bool skip = late_ns_ > kFrame && now - picture_ns_ < kShown;
  if (!skip) picture_ns_ = now;
  time_control_.skip_picture = skip;
}

bool Pacer::due(double time) noexcept {
  late_ns_ = 0;
  if (time_control_.paused) {
    speed_ = 0;
    if (steps_ == time_control_.steps) return false;
    ++steps_;
    return true;
  }
  steps_ = time_control_.steps;
  const std::int64_t now = clock_.now();
  const double speed = time_control_.speed;
  if (speed != speed_) {
    speed_ = speed;
    anchor_time_ = time;
    anchor_ns_ = now;
  }
  const std::int64_t at = anchor_ns_ + static_cast<std::int64_t>((time - anchor_time_) / speed * 1e9);
  if (at - now > kFrame) {  // slow motion: return to refresh the window
    clock_.sleep_until(now + kFrame);
    return false;
  }
  late_ns_ = now - at;
  if (late_ns_ > kBehind) speed_ = 0;
  if (at > now) clock_.sleep_until(at);
  return true;
}

}  // namespace presa
