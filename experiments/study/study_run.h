#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "framework/session/session.h"
#include "framework/core/schedule/executor.h"

namespace presa {

/// What one study run is made from.
struct StudySpec {
  std::string scene{};              ///< file
  std::string rig{};                ///< file; empty: the scene's own
  std::vector<std::string> sets{};  ///< PATH=VALUE
  double duration = 0;              ///< simulated seconds; 0: to the end of the script (10 s without one)
  std::uint64_t seed = 1;
  double trace_rate = 0;   ///< samples per second in monitor().trace(); 0: none
  double force_share = 1;  ///< of the force limits
};

/// The states at one haptic tick, after the output stage. References hold during the call only.
struct StudySample {
  const Tick& tick;
  const DeviceState& device;
  const ContactExchange& contact;
  const ForceCommand& command;
  const ObjectState* objects;     ///< newest, null without dynamics; poseAt(body, tick.time) is where a body is now
  std::uint64_t objects_version;  ///< grows by one with every dynamics step
};

/// One lockstep run of a scene in virtual time, without terminal, view or recording. The same spec gives the same bits.
/// Thread: main; one at a time. Throws InputError with every finding; no other exception for bad input.
class StudyRun {
 public:
  using Observer = std::function<void(const StudySample&)>;
  using MakeModule = std::function<std::unique_ptr<Module>(const std::shared_ptr<const World>&)>;
  /// `devices`: used instead of the rig's drivers, in the order of the scene's roles; empty: the rig's.
  /// `more` makes a module that runs with it, such as one that publishes its state.
  explicit StudyRun(const StudySpec& spec, DeviceList devices = {}, const MakeModule& more = {});
  ~StudyRun();

  const World& world() const noexcept { return *world_; }
  double duration() const noexcept { return duration_; }
  /// As engineVersions().
  const std::vector<std::string>& engines() const noexcept { return engines_; }
  /// Called in every haptic tick, last in the group. Before run().
  void observe(Observer observer);
  /// Asked before every tick of a group whether it is held up (see LockstepExecutor::delay). Before run().
  void delay(std::function<bool(RateGroup, double)> held_up);
  /// Execution times in timing() become processor time of this thread. Before run().
  void timeProcessor() { executor_->timeBy(threadCpuNs); }
  /// Latched faults are forgiven; from an observer.
  void rearm() noexcept { ++control_.rearms; }
  void run();

  const Monitor& monitor() const noexcept { return session_->monitor(); }
  const GroupTiming& timing(RateGroup group) const noexcept { return executor_->timing(group); }
  Session& session() noexcept { return *session_; }

 private:
  class Probe;
  std::shared_ptr<const World> world_;
  RunControl control_;
  double duration_ = 0;
  std::vector<std::string> engines_;
  Probe* probe_ = nullptr;  // owned by the session's graph
  std::unique_ptr<Session> session_;
  std::unique_ptr<LockstepExecutor> executor_;
};

}  // namespace presa
