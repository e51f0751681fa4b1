#include "apps/common/terminal_run.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <optional>

#include "apps/common/assembly_observer.h"
#include "apps/common/joint_observer.h"
#include "apps/common/live_observer.h"
#include "apps/common/machine.h"
#include "apps/common/pacer.h"
#include "apps/common/terminal/interruption.h"
#include "apps/common/terminal/keys.h"
#include "apps/common/terminal/load_progress.h"
#include "apps/common/terminal/prompt_end.h"
#include "apps/common/terminal/status_line.h"
#include "apps/common/version.h"
#include "framework/core/schedule/clock.h"
#include "framework/device/device_modules.h"
#include "framework/device/frame_watch.h"
#include "framework/device/frame_words.h"
#include "framework/session/realtime_policy.h"

namespace presa {
namespace {

// the run that a signal stops; a second signal ends it at once
std::atomic<RunControl*> signalled{nullptr};
std::atomic<bool> interrupted{false};
std::atomic<std::int64_t> first_signal_ns{0};
std::atomic<const char*> answer{nullptr};  // printed at once by a run that cannot end at once; null: no words

extern "C" void onSignal(int) {
  RunControl* control = signalled.load();
  if (control == nullptr) return;
  // one key press may arrive twice, at the process and at its group: only a later signal ends the run at once
  const std::int64_t now = monotonicNs();
  std::int64_t first = 0;
  if (!first_signal_ns.compare_exchange_strong(first, now)) {
    if (now - first > 500'000'000) control->abort = true;
  } else if (const char* words = answer; words != nullptr) {
    (void)!::write(STDERR_FILENO, words, std::strlen(words));
  }
  control->stop_requested = true;
  interrupted = true;
  terminal::PromptEnd::ask();
}

/// During its lifetime, Ctrl-C, SIGTERM and SIGHUP stop the run instead of the process.
class SignalGuard {
 public:
  SignalGuard(RunControl& control, const char* words) : signals_(onSignal) {
    interrupted = false;
    first_signal_ns = 0;
    answer = words;
    signalled = &control;
  }
  ~SignalGuard() { signalled = nullptr; }
  SignalGuard(const SignalGuard&) = delete;
  SignalGuard& operator=(const SignalGuard&) = delete;

 private:
  terminal::EndSignals signals_;
};

constexpr double kSlowest = 1.0 / 64, kFastest = 64;  // as in the window
constexpr int kMaxReportedTrips = 6;                  // trips reported by a note each; further ones are counted

std::vector<RunResult::Phase> phasesOf(const Device& device) {
  const auto names = device.phases();
  const auto times = device.phaseTimes();
  const auto intents = device.phaseIntents();
  std::vector<RunResult::Phase> phases;
  for (std::size_t p = 0; p < names.size() && p + 1 < times.size(); ++p)
    phases.push_back({names[p], times[p], times[p + 1], p < intents.size() ? intents[p] : PhaseIntent::kNone});
  return phases;
}

constexpr std::int64_t kAwaitGuide = 60'000'000'000;  // longest wait for a guide in a viewer, in lockstep [ns]

constexpr double kMaxJointSamples = 1'000'000;  // of all joints of a run, for plots

/// As many samples of the joints as the trace has, of a run of any length.
JointLog jointLogFor(const Scene& scene, double duration, double trace_rate) {
  std::size_t positions = 1;
  for (const Joint& joint : scene.joints) positions += positionCount(joint);
  const double dynamics = scene.rates.dynamics, steps = duration * dynamics;
  const double most = kMaxJointSamples / static_cast<double>(positions);
  const double stride = std::max({1.0, std::round(dynamics / std::max(trace_rate, 1.0)), std::ceil(steps / most)});
  const double samples = trace_rate > 0 && std::isfinite(steps) ? std::min(most, steps / stride + 2) : 0;
  return {scene, static_cast<std::size_t>(samples), static_cast<std::size_t>(std::min(stride, 1e9))};
}

/// The phases of the first scripted device. Unless the user chose the time of the picture, it is the middle of the
/// hold.
void followScript(Loaded& loaded, std::vector<RunResult::Phase>& phases) {
  RunOptions& options = loaded.options;
  for (const auto& device : loaded.devices) {
    const auto times = device->phaseTimes();
    const auto intents = device->phaseIntents();
    if (times.empty()) continue;
    if (device == loaded.devices.front()) phases = phasesOf(*device);
    const auto hold = firstSpanOf(PhaseIntent::kHold, intents, times);
    if (hold && options.screenshot_time < 0) options.screenshot_time = (hold->begin + hold->end) / 2;
  }
  if (options.screenshot_time > options.duration) options.screenshot_time = -1;
}

}  // namespace

struct TerminalRun::Live {
  LiveValues values;
  StatusLine line;
  std::optional<terminal::Keys> keys;   // present while a re-arm by key is possible
  std::atomic<std::int32_t> filled{0};  // filled places of the assembly
  std::shared_ptr<const World> world;   // of the joints
  std::optional<JointLog> joints;       // only in a scene with joints
  std::vector<ToolSummary> tools;       // only in a scene with tools
  std::vector<std::uint32_t> doing;     // with the frames of the rig, when it was last said
  std::int64_t said_ns = 0;
  std::int64_t start_ns = 0;
  explicit Live(bool quiet) : line(quiet) {}
};

TerminalRun::TerminalRun(Loaded loaded, Settings settings)
    : settings_(std::move(settings)), live_(std::make_unique<Live>(settings_.quiet)) {
  for (const Diagnostic& warning : settings_.found.all()) result_.load_warnings.push_back(format(warning));
  followScript(loaded, result_.phases);
  RunOptions& options = loaded.options;
  const bool hardware = drivesHardware(loaded.plan.devices);
  options.force_share = forceShare(hardware, options, settings_.rights, result_.notes);
  paced_ = !options.realtime && (options.view == RunOptions::View::kWindow || settings_.paced) && !hardware;
  if (options.realtime)
    for (const std::string& line : whileOpening(loaded.plan)) live_->line.note(line);
  Session::Options session;
  session.trace_rate = settings_.trace_rate;
  session.wrap = settings_.wrap;
  session.guide = settings_.guide;
  session.more = observers(loaded);
  {
    std::optional<terminal::LoadProgress> progress;
    if (!settings_.quiet) progress.emplace();
    run_ = std::make_unique<Run>(std::move(loaded), control_, std::move(session));
  }
  run_->onPoll([this] { poll(); });
  offerToView();
  offerToCommands();
  for (const std::string& note : run_->session().notes()) result_.notes.push_back(note);
  for (const auto& device : run_->session().devices()) {
    for (const std::string& note : device->notes()) result_.notes.push_back(note);
  }
}

TerminalRun::~TerminalRun() = default;

std::vector<std::unique_ptr<Module>> TerminalRun::observers(const Loaded& loaded) {
  std::vector<std::unique_ptr<Module>> modules = std::move(settings_.more);
  live_->values.size(loaded.world->scene.devices.size());
  modules.push_back(std::make_unique<LiveObserver>(live_->values));
  if (const Scene& scene = loaded.world->scene; !scene.joints.empty()) {
    live_->world = loaded.world;
    live_->joints.emplace(jointLogFor(scene, loaded.options.duration, settings_.trace_rate));
    modules.push_back(std::make_unique<JointObserver>(*live_->joints));
  }
  if (loaded.world->scene.hasTools()) modules.push_back(std::make_unique<ToolLog>(loaded.world->scene, live_->tools));
  if (loaded.world->scene.assembly) modules.push_back(std::make_unique<AssemblyObserver>(live_->filled));
  if (paced_) modules.push_back(std::make_unique<Pacer>(time_control_, view_, control_, while_held_));
  return modules;
}

void TerminalRun::offerToView() {
  time_control_.speed = settings_.speed;
  view_ = run_->session().view();
  if (view_ == nullptr) return;
  if (paced_) view_->offerTime(time_control_, 0);
  std::array<const GroupTiming*, kRateGroupCount> timings{};
  for (int g = 0; g < kRateGroupCount; ++g) {
    const auto group = static_cast<RateGroup>(g);
    timings[static_cast<std::size_t>(g)] =
        run_->session().graph().runs(group) ? &run_->executor().timing(group) : nullptr;
  }
  view_->setTimings(timings);
  if (!settings_.scenes.empty()) view_->offerScenes(settings_.scenes, settings_.scene);
}

std::optional<SceneWish> TerminalRun::wish() const noexcept {
  return view_ != nullptr ? view_->sceneWanted() : std::nullopt;
}

// Parameters that commands may set besides the surfaces: those that the user at the window may set. No force, no limit
// and no re-arm: a remote user does not see the finger.
void TerminalRun::offerToCommands() {
  auto* commandable = dynamic_cast<bus::Commandable*>(run_->session().graph().find("bus_dds"));
  server_ = commandable != nullptr ? commandable->parameterServer() : nullptr;
  awaitGuide();
  if (server_ == nullptr) return;
  const auto always = [](double value) { return [value] { return value; }; };
  if (paced_) {
    while_held_ = [this](double time) { server_->serve(time); };
    server_->offer({"time/held", [this] { return time_control_.paused ? 1.0 : 0.0; }, always(0), always(1),
                    [this](double held) { time_control_.paused = held >= 0.5; }});
    server_->offer({"time/speed", [this] { return time_control_.speed.load(); }, always(kSlowest), always(kFastest),
                    [this](double speed) { time_control_.speed = speed; }});
  }
  // an undo is not recorded, and a replay without it would differ
  if (AssemblyControl* assembly = run_->session().assembly(); assembly != nullptr && run_->options().record.empty()) {
    server_->offer({"assembly/undone", [this] { return undone_; }, [this] { return undone_; },
                    [this] { return undone_ + 1; },
                    [this, assembly](double undone) {
                      if (undone < undone_ + 1) return;
                      ++undone_;
                      assembly->undo();
                    }});
  }
}

// In lockstep nobody's time passes, so the run begins with its guide.
void TerminalRun::awaitGuide() {
  auto* guidable = dynamic_cast<bus::Guidable*>(run_->session().graph().find("bus_dds"));
  desk_ = guidable != nullptr ? guidable->guideDesk() : nullptr;
  if (desk_ == nullptr || run_->options().realtime) return;
  desk_->awaitGuide([this, begin = std::int64_t{0}]() mutable {
    if (begin == 0) {
      begin = monotonicNs();
      const std::string waits = "waiting for a viewer that guides: presa view --join --guide";
      settings_.quiet ? void(std::fprintf(stderr, "%s\n", waits.c_str())) : live_->line.note(waits);
    }
    poll();
    return !control_.stop_requested && monotonicNs() - begin < kAwaitGuide;
  });
}

void TerminalRun::noteGuide() {
  if (desk_ == nullptr) return;
  for (const std::string& note : desk_->takeNotes()) {
    live_->line.note(note);
    result_.notes.push_back(note);
  }
}

void TerminalRun::noteCommands() {
  if (server_ == nullptr) return;
  for (const bus::ParameterServer::Done& done : server_->done()) {
    std::array<char, 240> text;
    std::snprintf(text.data(), text.size(), "%.3f s: a command set %s to %g", done.time, done.name.c_str(), done.value);
    result_.notes.emplace_back(text.data());
  }
  if (const std::size_t more = server_->doneCount() - server_->done().size(); more > 0)
    result_.notes.push_back("… and " + std::to_string(more) + " more commands");
}

const char* TerminalRun::answerToSignal() const {
  if (settings_.quiet) return nullptr;
  if (run_->options().realtime) return "\nstopping: forces fade to zero\n";
  if (!run_->options().video.empty()) return "\nstopping: the video is completed\n";
  return nullptr;
}

void TerminalRun::execute() {
  const SignalGuard guard(control_, answerToSignal());
  live_->start_ns = monotonicNs();
  result_.started = localNow();
  for (const std::string& note : result_.notes) live_->line.note(note);
  if (settings_.watch || (run_->options().realtime && run_->session().output() != nullptr)) live_->keys.emplace();
  {
    const terminal::PromptEnd prompt(control_, run_->options().realtime);
    run_->execute();
  }
  live_->keys.reset();
  live_->line.finish();
  finish();
}

// Called regularly on the main thread: faults, a closed window, the status line.
void TerminalRun::poll() {
  noteBrokenPlugin();
  FaultEvent event;
  while (run_->session().output() != nullptr && run_->session().output()->nextEvent(event)) {
    const std::string role = run_->world().scene.devices[static_cast<std::size_t>(event.finger)].role;
    if (const char* fault = latchedFault(event.status)) {
      device_lost_ = device_lost_ || (event.status & kOutputLost) != 0;
      fail(event.time, role + ": " + fault + "; the force went to zero and stays there");
      if (live_->keys && live_->keys->available())
        live_->line.note(role + ": " + fault + ". Check the device, then press r to re-arm.");
    }
    if ((event.status & kOutputWatchdog) != 0 && event.time > 0) {
      if (++watchdog_trips_ > kMaxReportedTrips) continue;
      std::array<char, 160> text;
      std::snprintf(text.data(), text.size(),
                    "%.3f s: %s: no sample, or contact information too old: force off until it came back", event.time,
                    role.c_str());
      result_.notes.emplace_back(text.data());
    }
  }
  if (const View* view = run_->session().view(); view != nullptr && view->wantsStop()) control_.stop_requested = true;
  noteObjectFaults();
  noteFrames();
  noteGuide();
  const char key = live_->keys ? live_->keys->next(0) : '\0';
  if (key == 'r') rearm();
  if (settings_.watch && !settings_.watch(run_->session(), key)) control_.stop_requested = true;
  showStatus();
}

void TerminalRun::rearm() {
  if (std::exchange(device_lost_, false)) {
    for (const std::string& line : whileOpening(run_->session().plan())) live_->line.note(line);
    for (const Diagnostic& finding : run_->session().reopenDevices(control_.stop_requested)) {
      live_->line.note(format(finding));
      device_lost_ = true;
    }
    if (device_lost_) return live_->line.note("not re-armed. Fix this, then press r again.");
  }
  control_.rearms.fetch_add(1, std::memory_order_relaxed);
  live_->line.note("re-armed: forces come back softly where the cause no longer exists");
}

void TerminalRun::fail(double time, std::string what) {
  if (Recorder* recorder = run_->session().recorder()) recorder->fault(time, what);
  result_.faults.push_back({time, std::move(what)});
}

void TerminalRun::showStatus() {
  if (!live_->line.due()) return;
  LiveStatus status;
  status.time = control_.time.load(std::memory_order_relaxed);
  status.duration = run_->options().duration;
  status.realtime = run_->options().realtime;
  status.wall_seconds = static_cast<double>(monotonicNs() - live_->start_ns) * 1e-9;
  status.haptic_ticks = run_->executor().timing(RateGroup::kHaptic).ticks;
  status.haptic_missed = run_->executor().timing(RateGroup::kHaptic).missed;
  status.losses = live_->values.losses.load(std::memory_order_relaxed);
  const auto phase = live_->values.phase.load(std::memory_order_relaxed);
  if (phase >= 0 && static_cast<std::size_t>(phase) < result_.phases.size()) {
    status.phase = result_.phases[static_cast<std::size_t>(phase)].name;
  }
  for (std::size_t f = 0; f < run_->world().scene.devices.size(); ++f) {
    status.fingers.push_back({run_->world().scene.devices[f].role,
                              static_cast<ContactMode>(live_->values.mode[f].load(std::memory_order_relaxed)),
                              live_->values.normal_force[f].load(std::memory_order_relaxed)});
  }
  live_->line.show(status);
}

/// One sentence when a user begins something else with a frame, at most one a second.
void TerminalRun::noteFrames() {
  const FrameWatch* frames = run_->session().frames();
  if (frames == nullptr || monotonicNs() - live_->said_ns < 1'000'000'000) return;
  const auto& all = run_->world().rig.frames;
  live_->doing.resize(all.size());
  for (std::size_t n = 0; n < all.size(); ++n) {
    const FrameNow now = frames->now(n);
    if (std::exchange(live_->doing[n], now.doing) == now.doing || now.doing == 0) continue;
    live_->line.note(frameSentence(all[n], now));
    live_->said_ns = monotonicNs();
  }
}

void TerminalRun::takeFrames() {
  const FrameWatch* watch = run_->session().frames();
  if (watch == nullptr) return;
  for (std::size_t n = 0; n < watch->last().frames.size(); ++n) {
    const Frame& frame = run_->world().rig.frames[n];
    const FrameNow& last = watch->last().frames[n];
    if (!frame.driven() && last.losses == 0) continue;
    result_.frames.push_back({frame.name, last.uses, last.refusals, last.losses, last.zoom});
    result_.notes.push_back(frameSummary(frame, last));
  }
}

void TerminalRun::noteBrokenPlugin() {
  const auto name = run_->session().brokenPlugin();
  if (!name || effect_reported_) return;
  effect_reported_ = true;
  fail(control_.time.load(std::memory_order_relaxed),
       *name + ": its plug-in computed a force above its bound or no number; every force went to zero");
}

void TerminalRun::noteObjectFaults() {
  const std::uint32_t all = live_->values.object_faults.load(std::memory_order_acquire);
  const std::uint32_t faults = all & ~reported_object_faults_;
  const double time = live_->values.object_fault_time.load(std::memory_order_relaxed);
  reported_object_faults_ = all;
  if ((faults & kFaultBodyFrozen) != 0)
    fail(time, "a body's motion became implausible: it was frozen, forces faded to zero");
  if ((faults & kFaultEngineFailed) != 0)
    fail(time, "the dynamics engine failed: all bodies were frozen, forces faded to zero");
  if ((faults & kFaultBadFinger) != 0)
    fail(time, "the dynamics received an invalid finger contact, forces faded to zero");
  if ((faults & kFaultBadEffect) != 0) noteBrokenPlugin();
}

/// What modules say at the end and did not say at the beginning.
void TerminalRun::noteModules() {
  for (int g = 0; g < kRateGroupCount; ++g) {
    for (const Module* module : run_->session().graph().modules(static_cast<RateGroup>(g))) {
      for (std::string& note : module->notes()) {
        if (std::ranges::find(result_.notes, note) != result_.notes.end()) continue;
        live_->line.note(note);
        result_.notes.push_back(std::move(note));
      }
    }
  }
}

void TerminalRun::finish() {
  const RunOptions& options = run_->options();
  if (watchdog_trips_ > kMaxReportedTrips) {
    result_.notes.push_back("… and " + std::to_string(watchdog_trips_ - kMaxReportedTrips) + " more of these");
  }
  noteModules();
  noteCommands();
  noteGuide();
  if (desk_ != nullptr) result_.notes.push_back(desk_->summary());
  result_.world = run_->session().world();
  result_.version = kVersion;
  result_.command = settings_.command;
  result_.seed = options.seed;
  result_.realtime = options.realtime;
  result_.interrupted = interrupted;
  result_.wall_seconds = run_->executor().wallSeconds();
  result_.realtime_missing = run_->executor().notes();
  for (int g = 0; g < kRateGroupCount; ++g) {
    const auto group = static_cast<RateGroup>(g);
    if (run_->session().graph().runs(group))
      result_.rates.push_back({group, run_->executor().rates().rate(group), &run_->executor().timing(group)});
  }
  takeMonitor(run_->session().monitor(), result_);
  result_.tools = live_->tools;
  if (live_->joints) result_.joints = &*live_->joints;
  takeFrames();
  if (const auto& assembly = run_->world().scene.assembly)
    result_.assembly = {static_cast<int>(assembly->goals.size()), live_->filled.load(std::memory_order_relaxed)};
  if (Recorder* recorder = run_->session().recorder()) {
    const RecorderStatus status = recorder->status();
    if (!options.record.empty())
      result_.recording = {options.record, status.rows, status.dropped};
    else
      result_.flight_records = recorder->files();
    for (std::string& fault : run_->recordingFaults())
      result_.faults.push_back({result_.simulated_seconds, std::move(fault)});
    if (status.dropped > 0)
      result_.notes.push_back(std::to_string(status.dropped) +
                              " rows of the recording were dropped: the disk was too slow");
  }
  if (const sound::SoundOutput* sound = run_->session().sound(); sound != nullptr && !sound->trouble().empty())
    result_.faults.push_back({result_.simulated_seconds, "no sound " + options.sound + ": " + sound->trouble()});
  if (View* view = run_->session().view()) {
    if (options.view == RunOptions::View::kWindow) result_.sharpness = view->sharpness();
    const View::Screenshot shot = view->screenshot();
    if (shot.outcome == View::Screenshot::Outcome::kWritten) result_.screenshot = options.screenshot;
    if (shot.outcome == View::Screenshot::Outcome::kFailed)
      result_.faults.push_back({result_.simulated_seconds, shot.message});
    if (const std::string trouble = view->videoTrouble(); !trouble.empty())
      result_.faults.push_back({result_.simulated_seconds, "no video " + options.video + ": " + trouble});
  }
}

}  // namespace presa
