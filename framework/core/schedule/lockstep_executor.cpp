#include <algorithm>
#include <array>

#include "framework/core/schedule/clock.h"
#include "framework/core/schedule/executor.h"

namespace presa {
namespace {

constexpr std::uint64_t kPollTicks = 100;

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
  static constexpr std::array kOrder{RateGroup::kDynamics, RateGroup::kCollision, RateGroup::kHaptic, RateGroup::kView,
                                     RateGroup::kBus};
  for (RateGroup group : kOrder) graph_.start(group);

  std::uint64_t end = rates_.ticksWithin(RateGroup::kHaptic, duration);
  const std::uint64_t fade = rates_.ticksWithin(RateGroup::kHaptic, kFadeTime);
  bool stopping = false;
  const std::int64_t begin = monotonicNs();
  for (std::uint64_t i = 0; i < end && !control_.abort.load(std::memory_order_relaxed); ++i) {
    for (RateGroup group : kOrder) {
      const auto divisor = static_cast<std::uint64_t>(rates_.divisor(group));
      if (!graph_.runs(group) || i % divisor != 0) continue;
      if (held_up_) {
        stepDelayed(group, i / divisor, rates_.tick(RateGroup::kHaptic, i).time);
      } else {
        stepTimed(group, i / divisor, {});
      }
    }
    control_.time.store(rates_.tick(RateGroup::kHaptic, i + 1).time, std::memory_order_relaxed);
    if (!stopping && control_.stop_requested.load(std::memory_order_relaxed)) {
      stopping = true;
      end = std::min(end, i + 1 + fade);
    }
    const std::int64_t leave_by = stopping ? control_.leave_by_ns.load(std::memory_order_relaxed) : RunControl::kNever;
    if (leave_by != RunControl::kNever && monotonicNs() >= leave_by) break;
    if (i % kPollTicks == 0) poll_();
  }
  wall_seconds_ = static_cast<double>(monotonicNs() - begin) * 1e-9;
  for (auto group = kOrder.rbegin(); group != kOrder.rend(); ++group) graph_.stop(*group);
}

}  // namespace presa
