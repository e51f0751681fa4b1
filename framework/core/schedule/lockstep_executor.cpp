#include <algorithm>
#include <array>

#include "framework/core/schedule/clock.h"
#include "framework/core/schedule/executor.h"

namespace presa {
namespace {

constexpr std::uint64_t kPollTicks = 100;
constexpr std::array kOrder{RateGroup::kDynamics, RateGroup::kCollision, RateGroup::kHaptic, RateGroup::kView,
                            RateGroup::kBus};

}  // namespace

void LockstepExecutor::stepDelayed(RateGroup group, std::uint64_t index, double now) noexcept {
  if (held_up_(group, now)) return;
  GroupTiming& timing = timings_[static_cast<std::size_t>(group)];
  std::uint64_t& done = done_[static_cast<std::size_t>(group)];
  const std::uint64_t late = index - done;
  if (late > rates_.ticksWithin(group, kCatchUpLimit)) {
    timing.skipped.fetch_add(late, std::memory_order_relaxed);
    done = index;
  }
  timing.missed.fetch_add(index - done, std::memory_order_relaxed);
  const bool resumed = late > rates_.ticksWithin(group, kGap);  // all but the newest tick have been skipped
  for (; done <= index; ++done) stepTimed(group, done, {done < index, done < index, resumed});
}

void LockstepExecutor::run(double duration) {
  begin(duration);
  advance(end_);
  finish();
}

void LockstepExecutor::begin(double duration) {
  for (RateGroup group : kOrder) graph_.start(group);
  end_ = rates_.ticksWithin(RateGroup::kHaptic, duration);
  next_ = 0;
  stopping_ = false;
  wall_seconds_ = 0;
}

bool LockstepExecutor::advance(std::uint64_t ticks) {
  const std::int64_t begin = monotonicNs();
  const auto aborted = [this] { return control_.abort.load(std::memory_order_relaxed); };
  for (; ticks > 0 && next_ < end_ && !aborted(); --ticks, ++next_) {
    stepGroups();
    control_.time.store(rates_.tick(RateGroup::kHaptic, next_ + 1).time, std::memory_order_relaxed);
    if (!stopping_ && control_.stop_requested.load(std::memory_order_relaxed)) {
      stopping_ = true;
      end_ = std::min(end_, next_ + 1 + rates_.ticksWithin(RateGroup::kHaptic, kFadeTime));
    }
    const std::int64_t leave_by = stopping_ ? control_.leave_by_ns.load(std::memory_order_relaxed) : RunControl::kNever;
    if (leave_by != RunControl::kNever && monotonicNs() >= leave_by) end_ = next_ + 1;
    if (next_ % kPollTicks == 0) poll_();
  }
  wall_seconds_ += static_cast<double>(monotonicNs() - begin) * 1e-9;
  return next_ < end_ && !aborted();
}

void LockstepExecutor::stepGroups() noexcept {
  for (RateGroup group : kOrder) {
    const auto divisor = static_cast<std::uint64_t>(rates_.divisor(group));
    if (!graph_.runs(group) || next_ % divisor != 0) continue;
    if (held_up_) {
      stepDelayed(group, next_ / divisor, rates_.tick(RateGroup::kHaptic, next_).time);
    } else {
      stepTimed(group, next_ / divisor, {});
    }
  }
}

void LockstepExecutor::finish() {
  for (auto group = kOrder.rbegin(); group != kOrder.rend(); ++group) graph_.stop(*group);
}

}  // namespace presa
