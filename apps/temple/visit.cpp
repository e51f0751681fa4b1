#include "apps/temple/visit.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

#include "apps/common/atomic_file.h"
#include "apps/common/terminal_run.h"
#include "apps/temple/help/help_level.h"
#include "apps/temple/help/helped_finger.h"
#include "apps/temple/shared_finger.h"
#include "apps/temple/sound/hit_watch.h"
#include "apps/temple/sound/stone_sound.h"
#include "apps/temple/visit_counts.h"
#include "apps/temple/visit_log.h"
#include "apps/temple/visit_observer.h"
#include "apps/temple/voice.h"
#include "framework/assembly/captions.h"
#include "framework/core/diagnostics/printable.h"
#include "framework/device/device_plugin.h"
#include "framework/sound/loudspeaker.h"

namespace presa::temple {
namespace {

constexpr double kPutDownSpeed = 0.15;  // as what a stone is heard that is put into its place [m/s]
constexpr double kShownFinish = 10;     // pause after the hands have finished, before the next ruins [s]
// after completion: until the next task is offered, until it begins, and since the last touch at the least [s]
constexpr double kOffered = 12, kOnward = 60, kOnwardUntouched = 30;

/// Where the guide runs, for the log.
const char* guideOf(const RunOptions& options) {
  return options.guide == RunOptions::Guide::kViewer ? "viewer" : "beside";
}

class Visit {
 public:
  Visit(Loaded loaded, const VisitSettings& settings)
      : settings_(settings),
        world_(loaded.world),
        options_(loaded.options),
        assembly_(*world_->scene.assembly),
        counts_(settings.counts, settings.start.size) {
    auto rebuild_observer = std::make_unique<RebuildObserver>(world_);
    auto observer = std::make_unique<VisitObserver>(*world_);
    rebuild_observer_ = rebuild_observer.get();
    observer_ = observer.get();
    TerminalRun::Settings run{.quiet = settings.quiet, .command = "presa temple", .guide = true};
    run.more.push_back(std::move(rebuild_observer));
    run.more.push_back(std::move(observer));
    if (settings.sound || !settings.sound_file.empty()) {
      auto hits = std::make_unique<HitWatch>(world_, settings.density, settings.full_size);
      hits_ = hits.get();
      run.more.push_back(std::move(hits));
    }
    run.paced = settings.time_scale > 0;
    if (run.paced) run.speed = settings.time_scale;
    if (settings.help) addHelp(run);
    run.wrap = [this](DeviceList devices) {
      if (help_) devices = helped(std::move(devices), help_);
      return settings_.attract > 0 ? share(std::move(devices)) : std::move(devices);
    };
    run.watch = [this](Session& session, char key) { return watch(session, key); };
    run_ = std::make_unique<TerminalRun>(std::move(loaded), std::move(run));
    if (settings.sound) loudspeaker_ = std::make_unique<sound::Loudspeaker>();
    if (settings.voice) voice_.emplace(settings.language);
    if (!settings.folder.empty())
      log_.emplace(settings.folder, settings.start, world_->scene, settings.language, guideOf(options_));
  }

  VisitEnd go() {
    run_->execute();
    const RunResult& result = run_->result();
    for (const auto& fault : result.faults) std::fprintf(stderr, "%s\n", printable(fault.text).c_str());
    if (options_.guide == RunOptions::Guide::kViewer)
      for (const std::string& note : result.notes) std::fprintf(stderr, "%s\n", printable(note).c_str());
    Rebuilt rebuilt = measure(assembly_, *rebuild_observer_);
    rebuilt.wall_seconds = result.wall_seconds;
    rebuilt.simulated_seconds = result.simulated_seconds;
    rebuilt.interrupted = result.interrupted;
    if (log_) log_->note("end", rebuilt.simulated_seconds);
    counts_.leave(rebuilt.simulated_seconds);
    if (hits_ != nullptr) hear({});
    if (!settings_.sound_file.empty()) writeFileAtomically(settings_.sound_file, sound::wavOf(heard_));
    return {rebuilt, onward_, again_};
  }

 private:
  void addHelp(TerminalRun::Settings& run) {
    if (!std::ranges::any_of(world_->rig.devices, [](const DeviceBinding& d) { return d.driver == "pointer"; })) return;
    help_ = std::make_shared<GraspHelp>(world_);
    auto level = std::make_unique<HelpLevel>(world_, help_);
    help_level_ = level.get();
    run.more.push_back(std::move(level));
  }

  DeviceList share(DeviceList devices) {
    for (std::unique_ptr<Device>& device : devices) {
      auto shared = std::make_unique<SharedFinger>(std::move(device));
      fingers_.push_back(shared.get());
      device = std::move(shared);
    }
    return devices;
  }

  bool watch(Session& session, char key) {
    observer_->showOn(session.view());
    const VisitObserver::Snapshot snapshot = observer_->snapshot();
    const std::vector<GuideEvent> events = observer_->takeEvents();
    if (log_) log_->note(events, snapshot);
    if (log_ && help_level_ != nullptr) log_->note(help_level_->takeNotes());
    if (voice_) speak(snapshot.now);
    if (hits_ != nullptr) hear(events);
    const std::uint32_t inputs = session.view() != nullptr ? session.view()->inputs() : 0;
    const bool touched = std::exchange(inputs_, inputs) != inputs || key != '\0';
    if (settings_.attract > 0) takeTurns(snapshot, touched);
    if (touched) last_input_ = snapshot.time;
    undo(session, key);
    if (settings_.progress && !settings_.progress(snapshot.now.placed, snapshot.now.all)) return false;
    if (snapshot.now.placed < snapshot.now.all)
      done_at_.reset();
    else if (!done_at_)
      done_at_ = snapshot.time;
    count(snapshot, touched);
    if (done_at_ && !attracting_) goOn(session, key, snapshot.time);
    again_ = done_at_ && attracting_ && snapshot.time > *done_at_ + kShownFinish;
    return !again_ && !onward_ && (settings_.finish < 0 || !done_at_ || snapshot.time < *done_at_ + settings_.finish);
  }

  // A visit lasts from the first touch until the building stands or the hands take over.
  void count(const VisitObserver::Snapshot& snapshot, bool touched) {
    if (attracting_) return counts_.leave(snapshot.time);
    if (done_at_) return counts_.finish(*done_at_);
    if (touched || (snapshot.touched > 0 && snapshot.touched == snapshot.time)) counts_.touch(snapshot.time);
  }

  // What was rebuilt, then what comes next, which begins by itself or when it is asked for.
  void goOn(Session& session, char key, double time) {
    const std::uint32_t wanted = session.view() != nullptr ? session.view()->onwardsWanted() : 0;
    const bool asked = std::exchange(onwards_, wanted) != wanted || key == ' ';
    const double begins = std::max(*done_at_ + kOnward, last_input_ + kOnwardUntouched);
    const bool offered = !settings_.next.offers.empty() && time > *done_at_ + kOffered;
    observer_->setBanner(offered ? fillIn(settings_.next.offers, "time", durationText(std::ceil(begins - time)))
                                 : settings_.task.stands);
    onward_ = !settings_.next.offers.empty() && (asked || time >= begins);
  }

  void hear(const std::vector<GuideEvent>& events) {
    std::vector<Hit> hits = hits_->take();
    for (const GuideEvent& event : events)
      if (event.kind == GuideEvent::Kind::kPlaced && event.body != kNoBody)
        hits.push_back({event.time, kPutDownSpeed, hits_->lengthOf(static_cast<std::size_t>(event.body))});
    for (const Hit& hit : hits) {
      if (loudspeaker_) loudspeaker_->play(strikeOf(hit));
      if (!settings_.sound_file.empty()) heard_.push_back(strikeOf(hit));
    }
  }

  // What the screen says about the block in hand, and at the end.
  void speak(const Guidance& now) {
    const Captions captions = captionsOf(world_->scene, now);
    if (now.held || now.finished) voice_->say(now.finished ? captions.finish : captions.sentence);
  }

  // The visitor takes over by moving the device or pressing a key or button; the hands take over after a pause.
  void takeTurns(const VisitObserver::Snapshot& snapshot, bool touched) {
    if (attracting_) {
      for (const SharedFinger* finger : fingers_) touched = touched || finger->visitorMoved();
      if (touched) give(snapshot, false);
      return;
    }
    if (touched) touched_at_ = snapshot.time;
    const bool at_once = std::exchange(at_once_, false);
    if (at_once || snapshot.time - std::max(touched_at_, snapshot.touched) > settings_.attract) give(snapshot, true);
  }

  void give(const VisitObserver::Snapshot& snapshot, bool to_hands) {
    attracting_ = to_hands;
    if (help_) help_->setActive(!to_hands);
    touched_at_ = snapshot.time;
    for (std::size_t f = 0; f < fingers_.size(); ++f) fingers_[f]->give(to_hands ? makeHand(f) : nullptr);
    observer_->setBanner(to_hands ? assembly_.words.invitation : "");
    if (log_) log_->note(to_hands ? "attract" : "takeover", snapshot.time);
  }

  std::unique_ptr<Device> makeHand(std::size_t finger) const {
    Diagnostics diagnostics;
    DeviceBinding binding;
    binding.role = world_->scene.devices[finger].role;
    binding.driver = "assembling_hand";
    DeviceList hand = devicePlugin(binding.driver).create({binding}, world_, options_, diagnostics);
    if (diagnostics.hasErrors()) throw InputError(diagnostics);
    return std::move(hand.front());
  }

  void undo(Session& session, char key) {
    const std::uint32_t wanted = session.view() != nullptr ? session.view()->undosWanted() : 0;
    const std::uint32_t asked = std::exchange(undone_, wanted);
    AssemblyControl* const assembly = session.assembly();
    if (assembly == nullptr) return;  // the guide is in a viewer, and so is the key
    for (std::uint32_t n = asked; n != wanted; ++n) assembly->undo();
    if (key == 'u') assembly->undo();
  }

  const VisitSettings& settings_;
  std::shared_ptr<const World> world_;
  const RunOptions options_;
  const Assembly& assembly_;
  const RebuildObserver* rebuild_observer_ = nullptr;  // this and observer_: owned by the run
  VisitObserver* observer_ = nullptr;
  std::shared_ptr<GraspHelp> help_;  // null: no help
  HelpLevel* help_level_ = nullptr;  // owned by the run, with help_
  std::unique_ptr<TerminalRun> run_;
  std::optional<VisitLog> log_;
  std::optional<Voice> voice_;
  HitWatch* hits_ = nullptr;  // owned by the run; null: nothing is heard
  std::unique_ptr<sound::Loudspeaker> loudspeaker_;
  std::vector<sound::Strike> heard_;  // for the file
  std::optional<double> done_at_;     // [s]
  std::uint32_t undone_ = 0, inputs_ = 0, onwards_ = 0;
  VisitCounts counts_;
  double last_input_ = -1e300;  // [s]
  bool onward_ = false;
  std::vector<SharedFinger*> fingers_;  // owned by the run; empty unless settings_.attract > 0
  double touched_at_ = 0;               // [s]
  bool at_once_ = settings_.attracting, attracting_ = false, again_ = false;
};

}  // namespace

VisitEnd visit(Loaded loaded, const VisitSettings& settings) { return Visit(std::move(loaded), settings).go(); }

}  // namespace presa::temple
