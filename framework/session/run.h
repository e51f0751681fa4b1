#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/core/schedule/executor.h"
#include "framework/session/haptic_processor.h"
#include "framework/session/session.h"

namespace presa {

/// One run of a loaded scene from start to end: session, executor, and the end of its recording. Every command, study,
/// experiment and test that runs a scene does it with this. Thread: main.
class Run {
 public:
  /// Builds the session and opens the devices. `control` outlives this; modules in `options` may keep it, too. Throws
  /// InputError with every finding.
  Run(Loaded loaded, RunControl& control, Session::Options options = {});

  /// Runs RunOptions::duration, or until RunControl::stop_requested and the fade; then closes the recording. Rethrows
  /// what a module threw in start(). Call once.
  void execute();
  /// The parts of execute() in lockstep, for a caller that acts between ticks: LockstepExecutor::begin, advance, finish.
  void begin() { lockstep().begin(options().duration); }
  bool advance(std::uint64_t ticks) { return lockstep().advance(ticks); }
  void finish();
  /// `poll` is called on this thread during execute() (see Executor::onPoll) and once after the last tick.
  void onPoll(std::function<void()> poll);

  Session& session() noexcept { return *session_; }
  Executor& executor() noexcept { return *executor_; }
  const GroupTiming& timing(RateGroup group) const noexcept { return executor_->timing(group); }
  /// The executor of a lockstep run, which can simulate stalls. Throws std::logic_error in real time.
  LockstepExecutor& lockstep();
  const World& world() const noexcept { return *session_->world(); }
  const RunOptions& options() const noexcept { return session_->options(); }
  const Monitor& monitor() const noexcept { return session_->monitor(); }

  /// After execute(): in sentences, a recording that could not be written.
  std::vector<std::string> recordingFaults() const;

 private:
  void close();

  std::optional<HapticProcessor> haptic_processor_;  // before any thread of the session starts
  std::unique_ptr<Session> session_;
  std::unique_ptr<Executor> executor_;
  std::function<void()> poll_ = [] {};
};

}  // namespace presa
