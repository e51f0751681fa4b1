#include "apps/temple/shared_finger.h"

#include <utility>

namespace presa::temple {

void SharedFinger::give(std::unique_ptr<Device> hand) {
  moved_.store(false, std::memory_order_relaxed);
  last_ = std::exchange(hand_, std::move(hand));
  given_.store(hand_.get(), std::memory_order_release);
}

void SharedFinger::change(const Tick& tick) noexcept {
  Device* const given = given_.load(std::memory_order_acquire);
  if (given == moving_) return;
  moving_ = given;
  changed_ = tick;
  back_at_ = tick.time + kPause;
  left_known_ = false;
}

Tick SharedFinger::sinceChange(const Tick& tick) const noexcept {
  Tick own = tick;
  own.index = tick.index - changed_.index;
  own.time = tick.time - changed_.time;
  return own;
}

void SharedFinger::see(const ObjectState& objects, const Tick& tick) noexcept {
  change(tick);
  if (moving_ != nullptr) moving_->see(objects, sinceChange(tick));
  if (inner().looks()) inner().see(objects, tick);
}

FingerInput SharedFinger::read(const Tick& tick) noexcept {
  change(tick);
  const FingerInput visitor = inner().read(tick);
  if (moving_ != nullptr && visitor.valid) {
    if (!std::exchange(left_known_, true)) left_ = visitor;
    if ((visitor.p_WH - left_.p_WH).norm() > kMoves || visitor.buttons != left_.buttons)
      moved_.store(true, std::memory_order_relaxed);
  }
  FingerInput input = moving_ != nullptr ? moving_->read(sinceChange(tick)) : visitor;
  if (tick.time < back_at_) input.valid = false;
  return input;
}

void SharedFinger::write(const Wrench& F_H_W, const Tick& tick) noexcept {
  inner().write(moving_ != nullptr ? Wrench() : F_H_W, tick);
  if (moving_ != nullptr) moving_->write(F_H_W, sinceChange(tick));
}

}  // namespace presa::temple
