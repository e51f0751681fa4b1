#include "framework/core/schedule/executor.h"

namespace presa {

void Executor::stepTimed(RateGroup group, std::uint64_t index, Delay delay) noexcept {
  GroupTiming& timing = timings_[static_cast<std::size_t>(group)];
  Tick tick = rates_.tick(group, index);
  tick.late = delay.late;
  tick.catch_up = delay.catch_up;
  tick.resumed = delay.resumed;
  const std::int64_t begin = clock_();
  if (schedule_ == nullptr || !isScheduled(group)) {
    graph_.step(group, tick);
  } else {
    ScheduleRow row;
    graph_.step(group, tick, &row);
    schedule_->rings[static_cast<std::size_t>(group)]->push(row);
  }
  timing.execution.add(clock_() - begin);
  timing.ticks.fetch_add(1, std::memory_order_relaxed);
}

std::unique_ptr<Executor> makeExecutor(bool realtime, Graph& graph, const RateTable& rates, RunControl& control) {
  if (realtime) return std::make_unique<RealtimeExecutor>(graph, rates, control);
  return std::make_unique<LockstepExecutor>(graph, rates, control);
}

}  // namespace presa
