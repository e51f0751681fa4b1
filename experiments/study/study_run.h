#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/study/conditions.h"
#include "framework/session/run.h"

namespace presa {

/// Settings of one study run.
struct StudySpec {
  std::string scene{};              ///< file
  std::string rig{};                ///< file; empty: the rig named in the scene
  std::vector<std::string> sets{};  ///< PATH=VALUE
  double duration = 0;              ///< simulated seconds; 0: until the end of the script (10 s without one)
  std::uint64_t seed = 1;
  double trace_rate = 0;   ///< samples per second in monitor().trace(); 0: none
  double force_share = 1;  ///< scale of the force limits
  Conditions conditions{};
};

/// One lockstep run of a scene in virtual time, without terminal, view or recording. Bit-identical for the same spec.
/// Thread: main; one run at a time. Throws InputError with every finding, and nothing else for bad input.
class StudyRun {
 public:
  using Observer = std::function<void(const HapticSample&)>;
  using MakeModule = std::function<std::unique_ptr<Module>(const std::shared_ptr<const World>&)>;
  /// `devices` replaces the drivers of the rig, in the order of the scene's roles; empty: the rig's drivers. `more`
  /// creates an additional module, for example one that publishes the state.
  explicit StudyRun(const StudySpec& spec, DeviceList devices = {}, const MakeModule& more = {});
  ~StudyRun();

  const World& world() const noexcept { return run_->world(); }
  double duration() const noexcept { return run_->options().duration; }
  /// See engineVersions().
  const std::vector<std::string>& engines() const noexcept { return engines_; }
  /// `observer` is called in every haptic tick, last in the group; with a latency, its command is the one that the
  /// fingers feel. Call before run().
  void observe(Observer observer);
  /// `held_up` is asked before every tick of a group whether to skip it (see LockstepExecutor::delay), in place of the
  /// conditions' late ticks. Call before run().
  void delay(std::function<bool(RateGroup, double)> held_up);
  /// Makes timing() report processor time of this thread instead of wall time. Call before run().
  void timeProcessor() { run_->executor().timeBy(threadCpuNs); }
  /// Clears latched faults; may be called from an observer.
  void rearm() noexcept { ++control_.rearms; }
  void run() { run_->execute(); }

  const Monitor& monitor() const noexcept { return run_->monitor(); }
  const GroupTiming& timing(RateGroup group) const noexcept { return run_->timing(group); }
  Session& session() noexcept { return run_->session(); }

 private:
  class Probe;
  RunControl control_;
  std::vector<std::string> engines_;
  Probe* probe_ = nullptr;  // owned by the run
  std::optional<Run> run_;
};

}  // namespace presa
