#pragma once
#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "framework/core/graph/graph.h"
#include "framework/core/schedule/clock.h"
#include "framework/core/schedule/rates.h"
#include "framework/core/schedule/timing_stats.h"

namespace presa {

/// How a run ends early, and where it is. Shared by the program's main thread and an executor.
struct RunControl {
  std::atomic<bool> stop_requested{false};  ///< device input sees it at its next tick: forces fade
  std::atomic<bool> abort{false};           ///< leave now
  std::atomic<std::uint32_t> rearms{0};     ///< counted up by whoever has looked: latched faults are forgiven
  std::atomic<double> time{0};              ///< simulated time reached [s]
  /// Once stop is requested in virtual time: leave at this moment of monotonicNs(), faded or not.
  std::atomic<std::int64_t> leave_by_ns{kNever};
  static constexpr std::int64_t kNever = INT64_MAX;
};

/// Runs a graph for a while. Both executors run the same graph with the same ticks; they differ only in
/// who waits for whom.
class Executor {
 public:
  Executor(Graph& graph, RateTable rates, RunControl& control) : graph_(graph), rates_(rates), control_(control) {}
  virtual ~Executor() = default;

  /// Runs for `duration` simulated seconds, or, after a stop request, for kFadeTime longer. Returns when
  /// every group has stopped. Rethrows what a module threw in start().
  virtual void run(double duration) = 0;

  /// Called between ticks on the thread that called run(): every 100 haptic ticks in lockstep, every 20 ms in real time.
  void onPoll(std::function<void()> poll) { poll_ = std::move(poll); }
  void recordTo(ScheduleLog* schedule) noexcept { schedule_ = schedule; }
  /// Reads execution times from another clock [ns], such as threadCpuNs for studies of cost. Before run().
  void timeBy(std::int64_t (*clock)() noexcept) noexcept { clock_ = clock; }
  const GroupTiming& timing(RateGroup group) const noexcept { return timings_[static_cast<std::size_t>(group)]; }
  /// Wall time from the first tick's deadline to the end of the last haptic tick [s], without start-up.
  double wallSeconds() const noexcept { return wall_seconds_; }
  const RateTable& rates() const noexcept { return rates_; }
  /// What could not be had (scheduling class, locked memory), in words for the user.
  const std::vector<std::string>& notes() const noexcept { return notes_; }

  /// Simulated time from a stop request to the end: the output stage fades within it.
  static constexpr double kFadeTime = 0.15;
  /// A group that is late runs its missed ticks at once (Tick::made_up, all but the newest), so that simulated time
  /// follows the clock; after a stall longer than this it gives them up and counts them [s].
  static constexpr double kCatchUpLimit = 0.1;
  /// A group that has not run for longer than this is told so (Tick::resumed) [s].
  static constexpr double kGap = 1;

 protected:
  /// One tick of one group with its timing and its row in the schedule.
  void stepTimed(RateGroup group, std::uint64_t index, bool made_up = false, bool resumed = false) noexcept;

  Graph& graph_;
  RateTable rates_;
  RunControl& control_;
  ScheduleLog* schedule_ = nullptr;
  std::function<void()> poll_ = [] {};
  std::int64_t (*clock_)() noexcept = monotonicNs;
  std::array<GroupTiming, kRateGroupCount> timings_;
  std::vector<std::string> notes_;
  double wall_seconds_ = 0;
};

/// All groups on the calling thread in virtual time: deterministic to the bit, as fast as the machine goes.
/// At one instant the slow groups step before the fast ones: dynamics, collision, haptic, view, bus.
class LockstepExecutor final : public Executor {
 public:
  using Executor::Executor;
  void run(double duration) override;
  /// Stalls, for studies: asked at every instant at which a group is due, with the simulated time. While it says true the
  /// group's ticks wait; then they run at once, as in real time, those older than kCatchUpLimit are given up and counted.
  void delay(std::function<bool(RateGroup, double)> held_up) { held_up_ = std::move(held_up); }

 private:
  void stepDelayed(RateGroup group, std::uint64_t index, double now) noexcept;

  std::function<bool(RateGroup, double)> held_up_;
  std::array<std::uint64_t, kRateGroupCount> done_{};  // ticks run or given up, by group
};

/// One thread per rate group with absolute deadlines; SCHED_FIFO and locked memory where the system allows it.
class RealtimeExecutor final : public Executor {
 public:
  using Executor::Executor;
  void run(double duration) override;

 private:
  struct Shared;
  void runGroup(RateGroup group, double duration, Shared& shared);
  void loop(RateGroup group, double duration, Shared& shared);
};

std::unique_ptr<Executor> makeExecutor(bool realtime, Graph& graph, const RateTable& rates, RunControl& control);

}  // namespace presa
