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

/// SCHED_FIFO priority of the haptic thread: above ordinary work and softirqs, below the kernel's watchdogs (99).
inline constexpr int kHapticPriority = 80;

/// Requests to a running executor, and the time it has reached. Shared by the main thread and the executor's threads.
struct RunControl {
  std::atomic<bool> stop_requested{false};  ///< device input sees it at its next tick: forces fade
  std::atomic<bool> abort{false};           ///< leave after the current tick, without the fade
  std::atomic<std::uint32_t> rearms{0};     ///< number of re-arms; each one clears latched faults
  std::atomic<double> time{0};              ///< simulated time reached [s]
  /// Lockstep only, after a stop request: leave at this instant of monotonicNs(), even if the fade is not over.
  std::atomic<std::int64_t> leave_by_ns{kNever};
  static constexpr std::int64_t kNever = INT64_MAX;  ///< leave_by_ns: no such instant
};

/// Runs a graph for a given simulated time. Both executors step the same graph with the same ticks; they
/// differ only in threads and clock.
class Executor {
 public:
  /// `graph` and `control` must outlive it.
  Executor(Graph& graph, RateTable rates, RunControl& control) : graph_(graph), rates_(rates), control_(control) {}
  virtual ~Executor() = default;

  /// Runs for `duration` simulated seconds, or, after a stop request, for kFadeTime longer. Returns when
  /// every group has stopped. Rethrows what a module threw in start().
  virtual void run(double duration) = 0;

  /// Sets a function that run() calls on its own thread: every 100 haptic ticks in lockstep, every 20 ms in real time.
  void onPoll(std::function<void()> poll) { poll_ = std::move(poll); }
  /// Sets a function that run() calls in real time on the thread of each group, before Module::start().
  void onThread(std::function<void(RateGroup)> begin) { on_thread_ = std::move(begin); }
  void recordTo(ScheduleLog* schedule) noexcept { schedule_ = schedule; }  ///< null: none; call before run()
  /// Measures execution times with another clock [ns], such as threadCpuNs for studies of cost. Call before run().
  void timeBy(std::int64_t (*clock)() noexcept) noexcept { clock_ = clock; }
  /// Execution times and delays of a group; see GroupTiming for what may be read live.
  const GroupTiming& timing(RateGroup group) const noexcept { return timings_[static_cast<std::size_t>(group)]; }
  /// Wall time from the first tick's deadline to the end of the last haptic tick [s], without start-up.
  double wallSeconds() const noexcept { return wall_seconds_; }
  const RateTable& rates() const noexcept { return rates_; }  ///< in whole nanoseconds
  /// Real-time rights that the system refused (SCHED_FIFO, locked memory), in words for the user.
  const std::vector<std::string>& notes() const noexcept { return notes_; }

  static constexpr double kFadeTime = 0.15;  ///< simulated time from a stop request to the end: output fades in it [s]
  /// A late group runs its missed ticks at once (Tick::catch_up for all but the newest), so that simulated time follows
  /// the clock; after a stall longer than this it skips and counts them [s].
  static constexpr double kCatchUpLimit = 0.1;
  static constexpr double kGap = 1;  ///< after a longer gap, Tick::resumed is set in the group's first tick [s]

 protected:
  /// Delay of a tick.
  struct Delay {
    bool late = false,     ///< Tick::late
        catch_up = false,  ///< Tick::catch_up
        resumed = false;   ///< Tick::resumed
  };
  /// One tick of one group with its timing and its row in the schedule.
  void stepTimed(RateGroup group, std::uint64_t index, Delay delay) noexcept;

  Graph& graph_;                                                 ///< not owned
  RateTable rates_;                                              ///< rates of all groups
  RunControl& control_;                                          ///< not owned; shared with the main thread
  ScheduleLog* schedule_ = nullptr;                              ///< null: not recorded
  std::function<void()> poll_ = [] {};                           ///< by onPoll()
  std::function<void(RateGroup)> on_thread_ = [](RateGroup) {};  ///< by onThread()
  std::int64_t (*clock_)() noexcept = monotonicNs;               ///< by timeBy() [ns]
  std::array<GroupTiming, kRateGroupCount> timings_;             ///< by RateGroup
  std::vector<std::string> notes_;                               ///< by notes()
  double wall_seconds_ = 0;                                      ///< by wallSeconds() [s]
};

/// Runs all groups on the calling thread in virtual time: deterministic to the bit, as fast as the machine can.
/// Groups due at the same instant step in the order dynamics, collision, haptic, view, bus.
class LockstepExecutor final : public Executor {
 public:
  using Executor::Executor;  ///< as Executor's
  void run(double duration) override;
  /// The parts of run(), for a caller that acts between ticks: starts the groups for a run of `duration`; runs up to so
  /// many haptic ticks, false once the run is over; stops the groups.
  void begin(double duration);
  bool advance(std::uint64_t ticks);  ///< up to `ticks` haptic ones
  void finish();                      ///< Module::stop() in reverse order of groups
  /// Simulates stalls, for studies. `held_up` is called whenever a group is due, with the simulated time [s]; while it
  /// returns true, the group's ticks wait; then they run at once, or are skipped after kCatchUpLimit, as in real time.
  void delay(std::function<bool(RateGroup, double)> held_up) { held_up_ = std::move(held_up); }

 private:
  void stepGroups() noexcept;
  void stepDelayed(RateGroup group, std::uint64_t index, double now) noexcept;

  std::function<bool(RateGroup, double)> held_up_;
  std::array<std::uint64_t, kRateGroupCount> done_{};  // ticks run or given up, by group
  std::uint64_t next_ = 0, end_ = 0;                   // haptic ticks
  bool stopping_ = false;
};

/// Runs one thread per rate group with absolute deadlines; SCHED_FIFO and locked memory where the system allows it.
class RealtimeExecutor final : public Executor {
 public:
  using Executor::Executor;  ///< as Executor's
  void run(double duration) override;

 private:
  struct Shared;
  void runGroup(RateGroup group, double duration, Shared& shared);
  void loop(RateGroup group, double duration, Shared& shared);
};

/// A RealtimeExecutor or a LockstepExecutor; see Executor for the lifetimes.
std::unique_ptr<Executor> makeExecutor(bool realtime, Graph& graph, const RateTable& rates, RunControl& control);

}  // namespace presa
