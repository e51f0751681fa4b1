#include "apps/experiment/trial_run.h"

#include "apps/common/terminal/prompt_end.h"
#include "apps/experiment/surface_switch.h"
#include "apps/experiment/trial_tap.h"
#include "framework/session/load_world.h"
#include "framework/session/realtime_policy.h"
#include "framework/session/session.h"
#include "framework/session/view.h"

namespace presa::experiment {
namespace {

/// Refuses scenes that take commands: only the experiment may decide what subjects feel, and its log records it.
void refuseCommands(const World& world, Diagnostics& diagnostics) {
  if (!takesCommands(world)) return;
  diagnostics.error(730, {world.scene.file, 0, 0}, "its bus takes commands, which would change what subjects feel",
                    "take commands=\"true\" out of the <bus> of scene and rig");
}

double longestOf(const Experiment& experiment) {
  double seconds = 0;
  for (const Phase& phase : experiment.phases) seconds += phase.seconds + 1;
  return seconds;
}

/// A simulated subject depends on the experiment's seed and its number only: the same person in every trial.
SimulatedPerson personOf(const Experiment& experiment, int subject) {
  return {experiment.seed, static_cast<std::uint64_t>(subject), experiment.level};
}

/// Facts that the devices report: those of one run (`of_run`) or those of all runs.
std::vector<DeviceFact> factsOf(const DeviceList& devices, bool of_run) {
  std::vector<DeviceFact> facts;
  for (const auto& device : devices) {
    for (DeviceFact& fact : device->facts()) {
      if (fact.of_run == of_run) facts.push_back(std::move(fact));
    }
  }
  return facts;
}

/// The Session of one presentation: setup, run, result.
class TrialRun {
 public:
  TrialRun(const Experiment& experiment, const Presentation& presentation, std::uint64_t seed,
           const TrialSetting& setting)
      : setting_(setting),
        world_(load(experiment, presentation, seed, setting, plan_)),
        trial_(experiment, presentation.columns, 1 / world_->scene.rates.haptic) {
    Session::Options options;
    std::vector<std::string> notes;  // stays empty: an experiment is refused rather than run at reduced force
    forceShare(drivesHardware(plan_), world_->options, realtimeRights, notes);
    auto tap = std::make_unique<TrialTap>(trial_, experiment, world_->scene, control_);
    tap_ = tap.get();
    options.more.push_back(std::move(tap));
    if (setting.live != nullptr) {
      setting.live->roles.clear();
      for (const DeviceRole& role : world_->scene.devices) setting.live->roles.push_back(role.role);
      options.more.push_back(std::make_unique<OperatorTap>(trial_, experiment, *setting.live));
    }
    if (experiment.changesFriction()) options.more.push_back(std::make_unique<SurfaceSwitch>(trial_));
    session_ = std::make_unique<Session>(world_, plan_, control_, std::move(options));
    const RateTable rates(world_->scene.rates);
    executor_ = makeExecutor(setting.realtime, session_->graph(), rates, control_);
    executor_->onPoll([this] { poll(); });
    executor_->recordTo(session_->schedule());
  }

  TrialResult run() {
    {
      const terminal::PromptEnd prompt(control_, setting_.realtime);
      executor_->run(world_->options.duration);
    }
    poll();  // once more: a signal may have stopped the run between polls
    return result();
  }

 private:
  static std::shared_ptr<const World> load(const Experiment& experiment, const Presentation& presentation,
                                           std::uint64_t seed, const TrialSetting& setting, Plan& plan) {
    RunOptions options;
    options.realtime = setting.realtime;
    if (setting.window) options.view = RunOptions::View::kWindow;
    options.duration = longestOf(experiment);
    options.seed = seed;
    options.record = setting.record;
    options.person = personOf(experiment, setting.subject);
    Diagnostics diagnostics;
    Loaded loaded = loadWorld({experiment.scene, experiment.rig, presentation.sets}, options, diagnostics);
    if (!diagnostics.hasErrors()) refuseCommands(*loaded.world, diagnostics);
    if (diagnostics.hasErrors()) throw InputError(diagnostics);
    plan = std::move(loaded.plan);
    return loaded.world;
  }

  void poll() {
    if (setting_.on_time) setting_.on_time(control_.time.load(std::memory_order_relaxed));
    const bool closed = session_->view() != nullptr && session_->view()->wantsStop();
    if (stopped_ || (!closed && (!setting_.stop || !setting_.stop()))) return;
    stopped_ = true;
    control_.stop_requested = true;
  }

  TrialResult result() {
    TrialResult result;
    result.stopped = stopped_ && trial_.state() == Trial::State::kRunning;
    if (result.stopped) trial_.abort(tap_->time(), "stopped by the operator");
    if (const int finger = tap_->lostFinger(); finger >= 0 && trial_.state() == Trial::State::kRunning) {
      result.faults.push_back("the device of '" + world_->scene.devices[static_cast<std::size_t>(finger)].role +
                              "' gave no sample any more");
      trial_.abort(tap_->time(), result.faults.back());
    }
    trial_.abort(tap_->time(), "the run ended before the trial");
    const GroupTiming& haptic = executor_->timing(RateGroup::kHaptic);
    result.ticks = haptic.ticks;
    result.missed = haptic.missed;
    const std::vector<double> quality{static_cast<double>(result.missed), tap_->clippedSeconds(), tap_->lostSeconds(),
                                      tap_->mostForce()};
    result.state = trial_.state();
    result.reason = trial_.reason();
    result.phases = trial_.stretches();
    result.values = trial_.results(quality);
    if (result.state == Trial::State::kDone) result.excluded = trial_.exclusion(result.values);
    result.simulated_seconds = tap_->time();
    result.wall_seconds = executor_->wallSeconds();
    result.facts = factsOf(session_->devices(), true);
    if (session_->monitor().objectFaults() != 0) result.faults.emplace_back("fault in the dynamics");
    if (Recorder* recorder = session_->recorder()) {
      recorder->finish();
      if (recorder->status().failed) result.faults.push_back("the recording could not be written: " + setting_.record);
      if (recorder->status().dropped > 0) result.faults.emplace_back("rows of the recording were dropped");
    }
    return result;
  }

  const TrialSetting& setting_;
  Plan plan_;
  std::shared_ptr<const World> world_;
  Trial trial_;
  RunControl control_;
  TrialTap* tap_ = nullptr;  // owned by the session's graph
  std::unique_ptr<Session> session_;
  std::unique_ptr<Executor> executor_;
  bool stopped_ = false;
};

}  // namespace

std::vector<DeviceFact> traitsOf(const Experiment& experiment, int subject) {
  RunOptions options;
  options.person = personOf(experiment, subject);
  Diagnostics diagnostics;
  const Loaded loaded = loadWorld({experiment.scene, experiment.rig, experiment.sets}, options, diagnostics);
  const DeviceList devices = createDevices(*loaded.world, loaded.plan, diagnostics);
  if (!diagnostics.hasErrors()) refuseCommands(*loaded.world, diagnostics);
  if (diagnostics.hasErrors()) throw InputError(diagnostics);
  return factsOf(devices, false);
}

TrialResult present(const Experiment& experiment, const Presentation& presentation, std::uint64_t seed,
                    const TrialSetting& setting) {
  return TrialRun(experiment, presentation, seed, setting).run();
}

}  // namespace presa::experiment
