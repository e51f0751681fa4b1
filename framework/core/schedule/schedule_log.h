#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "framework/core/exchange/event_ring.h"
#include "framework/core/schedule/tick.h"

namespace presa {

/// One tick of one rate group: whether it was a catch-up tick, and the version of every value read across rates.
/// versions[i] belongs to name i of the group's ScheduleInputs. Thread timing makes these versions differ from run
/// to run; recording them makes a replay exact.
struct ScheduleRow {
  static constexpr int kMaxBridges = 12;  ///< values that one group may read across rates (E507)
  std::uint64_t index = 0;                ///< Tick::index
  std::uint64_t catch_up = 0;             ///< bit 0: Tick::catch_up, bit 1: Tick::resumed, bit 2: Tick::late
  std::array<std::uint64_t, kMaxBridges> versions{};  ///< 0: none yet
};

/// Groups whose ticks are recorded: all but the bus, which only publishes results of the others and is not needed for
/// a replay.
inline constexpr int kScheduledGroupCount = kRateGroupCount - 1;
constexpr bool isScheduled(RateGroup group) noexcept { return group != RateGroup::kBus; }  ///< its ticks are recorded

/// For each group: the port names of the values read across rates, each once, in the order of ScheduleRow::versions.
using ScheduleInputs = std::array<std::vector<std::string>, kScheduledGroupCount>;

/// Log to which the executors write when a run is recorded: one ring per rate group (one writer each), drained by the
/// recorder's writer thread.
struct ScheduleLog {
  ScheduleInputs inputs;  ///< Graph::scheduleInputs; set before a recorder is attached
  std::array<std::unique_ptr<EventRing<ScheduleRow>>, kScheduledGroupCount> rings;  ///< by RateGroup; drop when full
  ScheduleLog();                                                                    ///< allocates the rings
};

}  // namespace presa
