#include "apps/experiment/trial_run.h"

#include <algorithm>
#include <iterator>
#include <optional>

#include "apps/common/terminal/prompt_end.h"
#include "apps/experiment/participant.h"
#include "apps/experiment/surface_switch.h"
#include "apps/experiment/trial_observer.h"
#include "framework/session/realtime_policy.h"
#include "framework/session/run.h"

namespace presa::experiment {
namespace {

/// Refuses scenes that take commands: only the experiment may decide what subjects feel, and its log records it.
void refuseCommands(const Loaded& loaded, Diagnostics& diagnostics) {
  if (!loaded.options.bus_commands) return;
  diagnostics.error(730, {loaded.world->scene.file, 0, 0},
                    "its bus takes commands, which would change what subjects feel",
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

Loaded load(const Experiment& experiment, const std::vector<std::string>& sets, RunOptions options) {
  Diagnostics diagnostics;
  Loaded loaded = loadWorld({experiment.scene, experiment.rig, sets}, std::move(options), diagnostics);
  if (!diagnostics.hasErrors()) refuseCommands(loaded, diagnostics);
  if (diagnostics.hasErrors()) throw InputError(diagnostics);
  return loaded;
}

Loaded load(const Experiment& experiment, const Presentation& presentation, std::uint64_t seed,
            const TrialSetting& setting) {
  RunOptions options;
  options.realtime = setting.realtime;
  if (setting.window) {
    options.view = RunOptions::View::kWindow;
    options.participant = screenAfter(experiment, setting.language, setting.asks);
  }
  options.duration = longestOf(experiment);
  options.seed = seed;
  options.record = setting.record;
  options.person = personOf(experiment, setting.subject);
  return load(experiment, presentation.sets, std::move(options));
}

/// One presentation: setup, run, result.
class TrialRun {
 public:
  TrialRun(const Experiment& experiment, const Presentation& presentation, Loaded loaded, const TrialSetting& setting)
      : setting_(setting), trial_(experiment, presentation.columns, 1 / loaded.world->scene.rates.haptic) {
    std::vector<std::string> notes;  // stays empty: an experiment is refused rather than run at reduced force
    forceShare(drivesHardware(loaded.plan.devices), loaded.options, realtimeRights, notes);
    const Scene& scene = loaded.world->scene;
    Session::Options options;
    auto observer = std::make_unique<TrialObserver>(trial_, experiment, scene, control_);
    observer_ = observer.get();
    options.more.push_back(std::move(observer));
    if (setting.live != nullptr) {
      std::vector<std::string> roles;
      for (const DeviceRole& role : scene.devices) roles.push_back(role.role);
      setting.live->setRoles(std::move(roles));
      options.more.push_back(std::make_unique<OperatorObserver>(trial_, experiment, *setting.live));
    }
    if (experiment.changesFriction()) options.more.push_back(std::make_unique<SurfaceSwitch>(trial_));
    ParticipantDirector* const director = setting.window ? addDirector(experiment, options) : nullptr;
    run_.emplace(std::move(loaded), control_, std::move(options));
    if (director != nullptr) director->showOn(run_->session().view());
    run_->onPoll([this] { poll(); });
  }

  TrialResult run() {
    {
      const terminal::PromptEnd prompt(control_, setting_.realtime);
      run_->execute();
    }
    return result();
  }

 private:
  ParticipantDirector* addDirector(const Experiment& experiment, Session::Options& options) {
    std::vector<ParticipantScreen> screens;
    for (const Phase& phase : experiment.phases) screens.push_back(screenIn(experiment, phase, setting_.language));
    auto director = std::make_unique<ParticipantDirector>(*observer_, std::move(screens));
    ParticipantDirector* const made = director.get();
    options.more.push_back(std::move(director));
    return made;
  }

  void poll() {
    if (setting_.on_time) setting_.on_time(control_.time.load(std::memory_order_relaxed));
    const View* view = run_->session().view();
    const bool closed = view != nullptr && view->wantsStop();
    if (stopped_ || (!closed && (!setting_.stop || !setting_.stop()))) return;
    stopped_ = true;
    control_.stop_requested = true;
  }

  TrialResult result() {
    TrialResult result;
    result.stopped = stopped_ && trial_.state() == Trial::State::kRunning;
    if (result.stopped) trial_.abort(observer_->time(), "stopped by the operator");
    if (const int finger = observer_->lostFinger(); finger >= 0 && trial_.state() == Trial::State::kRunning) {
      result.faults.push_back("the device of '" + run_->world().scene.devices[static_cast<std::size_t>(finger)].role +
                              "' gave no sample any more");
      trial_.abort(observer_->time(), result.faults.back());
    }
    trial_.abort(observer_->time(), "the run ended before the trial");
    const GroupTiming& haptic = run_->executor().timing(RateGroup::kHaptic);
    result.ticks = haptic.ticks;
    result.missed = haptic.missed;
    const std::vector<double> quality{static_cast<double>(result.missed), observer_->clippedSeconds(),
                                      observer_->lostSeconds(), observer_->maxForce()};
    result.state = trial_.state();
    result.reason = trial_.reason();
    result.phases = trial_.stretches();
    result.values = trial_.results(quality);
    if (result.state == Trial::State::kDone) result.excluded = trial_.exclusion(result.values);
    result.simulated_seconds = observer_->time();
    result.wall_seconds = run_->executor().wallSeconds();
    result.facts = factsOf(run_->session().devices(), true);
    if (run_->monitor().objectFaults() != 0) result.faults.emplace_back("fault in the dynamics");
    std::ranges::move(run_->recordingFaults(), std::back_inserter(result.faults));
    if (const Recorder* recorder = run_->session().recorder(); recorder != nullptr && recorder->status().dropped > 0)
      result.faults.emplace_back("rows of the recording were dropped");
    return result;
  }

  const TrialSetting& setting_;
  Trial trial_;
  RunControl control_;
  TrialObserver* observer_ = nullptr;  // owned by the run
  std::optional<Run> run_;
  bool stopped_ = false;
};

}  // namespace

std::vector<DeviceFact> traitsOf(const Experiment& experiment, int subject) {
  RunOptions options;
  options.person = personOf(experiment, subject);
  return factsOf(load(experiment, experiment.sets, std::move(options)).devices, false);
}

TrialResult present(const Experiment& experiment, const Presentation& presentation, std::uint64_t seed,
                    const TrialSetting& setting) {
  return TrialRun(experiment, presentation, load(experiment, presentation, seed, setting), setting).run();
}

}  // namespace presa::experiment
