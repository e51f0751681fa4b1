#include "apps/presa/remote/viewer.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "apps/common/exit_status.h"
#include "apps/common/terminal/interruption.h"
#include "apps/presa/remote/guide_thread.h"
#include "apps/presa/remote/join.h"
#include "framework/assembly/guide_module.h"
#include "framework/bus/mesh_store.h"
#include "framework/bus/remote_picture.h"
#include "framework/bus/rig_frames.h"
#include "framework/core/diagnostics/printable.h"
#include "framework/core/diagnostics/refuse.h"
#include "framework/core/graph/graph_builder.h"
#include "framework/core/schedule/clock.h"
#include "framework/device/frame_words.h"
#include "framework/scene/load.h"
#include "framework/session/session.h"
#include "framework/session/view.h"

namespace presa {
namespace {

using bus::RemotePicture;

constexpr std::int64_t kPoll = 1'000'000;  ///< of a process of a CAVE [ns]

enum ViewerCode { kOtherGuideLeads = 768 };

/// The guide of this viewer, for its picture. Runs in the view group, before the view.
class GuideSource final : public Module {
 public:
  explicit GuideSource(const Guidance& now) : Module("guide", RateGroup::kView), now_(now) {}
  void step(const Tick&) noexcept override { guidance_.value.now = now_; }

 private:
  const Guidance& now_;
  Out<GuideState> guidance_{*this, "guidance"};
};

/// Writes the remote states to the ports that a view reads. Runs in the view group, before the view.
class RemoteSource final : public Module {
 public:
  /// `frames`: the rig has some. `cave`: null without one.
  RemoteSource(RemotePicture& picture, bool frames, View*& view, const Cave* cave)
      : Module("remote", RateGroup::kView), picture_(picture), view_(view), cave_(cave) {
    if (frames) frames_.emplace(*this, kFramesPort);
  }
  void step(const Tick&) noexcept override {
    // the picture forgets the states that a frozen wall shows, as new ones arrive
    if (cave_ == nullptr || !cave_->frozen()) {
      picture_.fill(objects_.value, device_.value, contact_.value, command_.value);
      if (frames_) picture_.fill(frames_->value);
    }
    if (view_ != nullptr) view_->setBanner(picture_.line() + remark_, picture_.alarm());
  }
  /// What the banner says besides.
  void setRemark(std::string remark) { remark_ = std::move(remark); }
  const ObjectState& objects() const { return objects_.value; }

 private:
  RemotePicture& picture_;
  View*& view_;
  const Cave* const cave_;
  std::string remark_;
  Out<ObjectState> objects_{*this, "object_state"};
  Out<DeviceState> device_{*this, "device_state"};
  Out<ContactExchange> contact_{*this, "contact_exchange"};
  Out<ForceCommand> command_{*this, "force_command"};
  std::optional<Out<FrameState>> frames_;
};

/// The scene that this viewer draws: the run's scene as it was sent, or the viewer's own.
std::shared_ptr<const World> worldOf(const ViewerSettings& settings, const bus::RunInfo& run) {
  Diagnostics diagnostics;
  const bool own = !settings.scene.empty();
  const auto sent = [&] {
    return parseScene(run.scene_xml, "scene '" + printable(run.scene_name) + "'", ".", {}, diagnostics);
  };
  Scene scene = own ? loadScene(settings.scene, {}, diagnostics) : sent();
  // a guide's goals are those of the run, whatever has become of the viewer's file
  if (own && settings.guide)
    if (Scene of_run = sent(); of_run.bodies.size() == scene.bodies.size()) scene.assembly = of_run.assembly;
  if (!own) bus::takeFromMeshStore(scene, run, settings.meshes, diagnostics);
  World world;
  if (!diagnostics.hasErrors()) world = buildWorld(std::move(scene), {}, diagnostics);
  if (diagnostics.hasErrors()) throw InputError(diagnostics);
  world.rig = bus::rigOf(run, world.scene);
  return std::make_shared<const World>(std::move(world));
}

RunOptions optionsOf(const ViewerSettings& settings) {
  RunOptions options;
  options.view = settings.view;
  options.screenshot = settings.screenshot;
  options.screenshot_time = settings.screenshot_time;
  options.show = settings.show;
  options.picture = settings.picture;
  options.bus = settings.bus;
  return options;
}

/// The picture follows the run's simulated time, one period behind; the machine's clock only decides when to draw.
class Viewer {
 public:
  Viewer(const ViewerSettings& settings, bus::Reader& reader, const bus::RunInfo& run)
      : settings_(settings), reader_(reader), world_(worldOf(settings, run)), picture_(*world_) {
    if (!run.frames.empty()) reader.expectFrames();
    picture_.onRun(run, monotonicNs());
    if (!settings.cave.walls.empty()) {
      CaveSettings cave = settings.cave;
      cave.max_rate = world_->scene.rates.view;
      cave_ = std::make_unique<Cave>(cave, settings.bus);
    }
    if (settings.guide) {
      guide_ = std::make_unique<GuideThread>(world_, run, settings.bus);
      guidance_ = guide_->now().guidance;
    }
    if (settings.view == RunOptions::View::kNone) return;
    GraphBuilder builder;
    auto source = std::make_unique<RemoteSource>(picture_, !world_->rig.frames.empty(), view_, cave_.get());
    source_ = source.get();
    builder.add(std::move(source));
    if (guide_ != nullptr)
      builder.add(std::make_unique<GuideSource>(guidance_));
    else if (world_->scene.assembly)
      builder.add(std::make_unique<GuideModule>(world_));
    auto view = makeView(world_, optionsOf(settings));
    view_ = view.get();
    if (cave_ != nullptr) view_->drawOnWall(*cave_->canvas());
    builder.add(std::move(view));
    builder.connectByName();
    graph_ = builder.build();
  }

  int show() {
    graph_.start(RateGroup::kView);
    const double period = 1 / world_->scene.rates.view;
    const std::int64_t begin = monotonicNs();
    std::int64_t next = begin, next_line = begin;
    Tick tick;
    tick.period = period;
    while (!done(begin)) {
      reader_.take(picture_);
      picture_.advance(monotonicNs());
      if (guide_ != nullptr && !heedGuide()) break;
      if (cave_ == nullptr || cave_->next(picture_, monotonicNs())) {
        tick.time = picture_.time();
        graph_.step(RateGroup::kView, tick);
        ++tick.index;
        if (cave_ != nullptr) cave_->drawn(drawnState(source_->objects()), monotonicNs());
      }
      if (!settings_.quiet && monotonicNs() >= next_line) {
        say();
        next_line = monotonicNs() + (isatty(STDERR_FILENO) != 0 ? 100'000'000 : 2'000'000'000);
      }
      // walls wait for each other's messages
      next = std::max(next + (cave_ == nullptr ? static_cast<std::int64_t>(period * 1e9) : kPoll), monotonicNs());
      if (picture_.state() != RemotePicture::State::kEnded) sleepUntilNs(next);
    }
    graph_.stop(RateGroup::kView);
    guide_.reset();
    if (!settings_.quiet) say(true);
    if (cave_ != nullptr) std::fprintf(stderr, "%s\n", cave_->summary().c_str());
    return verdict();
  }

 private:
  /// What the guide tells is drawn, and the window's undos go to it. False: another guide leads the run.
  bool heedGuide() {
    using Standing = bus::RemoteGuide::Standing;
    const bus::RemoteGuide::Now now = guide_->now();
    guidance_ = now.guidance;
    const std::uint32_t wanted = view_ != nullptr ? view_->undosWanted() : 0;
    for (; undone_ != wanted; ++undone_) guide_->undo();
    remark_ = now.standing == Standing::kLeads ? "; guides the run" : "; waits to guide";
    if (now.refusal != bus::OrderRefusal::kNone && now.standing != Standing::kOtherLeads)
      remark_ += std::string("; an order was refused: ") + bus::toString(now.refusal);
    if (source_ != nullptr) source_->setRemark(remark_);
    other_leads_ = now.standing == Standing::kOtherLeads;
    return !other_leads_;
  }
  bool done(std::int64_t begin) {
    if (terminal::Interruption::came() || (view_ != nullptr && view_->wantsStop())) return true;
    const double shown = static_cast<double>(monotonicNs() - begin) * 1e-9;
    if (settings_.duration > 0 && shown >= settings_.duration) return true;
    return picture_.state() == RemotePicture::State::kEnded && drawn_end_++ > 0;
  }
  void say(bool last = false) const {
    const bool terminal = isatty(STDERR_FILENO) != 0;
    std::string line = picture_.line() + remark_;
    if (const std::string frames = aboutFrames(); !frames.empty()) line += "; " + frames;
    if (cave_ != nullptr) line += "; " + cave_->line(monotonicNs());
    std::fprintf(stderr, terminal ? "\r\033[K%8.3f s  %s%s" : "%8.3f s  %s%s\n", picture_.time(), line.c_str(),
                 terminal && last ? "\n" : "");
  }
  std::string aboutFrames() const {
    FrameState now;
    picture_.fill(now);
    for (std::size_t n = 0; n < now.frames.size(); ++n)
      if (std::string text = frameSentence(world_->rig.frames[n], now.frames[n]); !text.empty()) return printable(text);
    return {};
  }
  int verdict() const {
    if (other_leads_) {
      std::fprintf(stderr,
                   "--guide: error[E%d]: another viewer guides this run, and a run follows one guide\n"
                   "  help: show it without --guide, or end the other viewer first\n",
                   kOtherGuideLeads);
      return kExitBadInput;
    }
    if (picture_.wrongScene()) return kExitBadInput;
    if (view_ != nullptr) {
      const View::Screenshot shot = view_->screenshot();
      if (shot.outcome != View::Screenshot::Outcome::kNotAsked) std::fprintf(stderr, "%s\n", shot.message.c_str());
      if (shot.outcome == View::Screenshot::Outcome::kFailed) return kExitFault;
    }
    return terminal::Interruption::came() ? kExitInterrupted : kExitOk;
  }

  const ViewerSettings& settings_;
  bus::Reader& reader_;
  std::shared_ptr<const World> world_;
  RemotePicture picture_;
  View* view_ = nullptr;  // owned by the graph, as the source
  RemoteSource* source_ = nullptr;
  std::unique_ptr<Cave> cave_;          // the view draws on its canvas
  std::unique_ptr<GuideThread> guide_;  // null: this viewer does not guide
  Guidance guidance_;
  std::string remark_;
  std::uint32_t undone_ = 0;
  bool other_leads_ = false;
  Graph graph_;
  int drawn_end_ = 0;
};

}  // namespace

int showRemote(const ViewerSettings& settings) {
  if (settings.view == RunOptions::View::kNone && !settings.screenshot.empty()) {
    Diagnostics diagnostics;
    diagnostics.error(121, {"--screenshot", 0, 0}, "a screenshot needs a view, found --view none",
                      "use --view offscreen");
    throw InputError(diagnostics);
  }
  if (settings.view == RunOptions::View::kNone && !settings.cave.wall.empty())
    refuse(121, "--wall", "a wall needs a view, found --view none, or no display",
           "DISPLAY is the screen of the wall's projector; without one use --view offscreen");
  const terminal::Interruption interruption;
  const auto reader = bus::openReader(settings.bus);
  const auto run = awaitRun(*reader, settings.wait);
  if (!run) {
    if (terminal::Interruption::came()) return kExitInterrupted;
    std::fprintf(stderr,
                 "bus: error[E722]: no run on network %s, domain %d, within %g s\n"
                 "  help: start it with presa run SCENE --bus %s, or wait longer: --wait S\n",
                 settings.bus.network.c_str(), settings.bus.domain, settings.wait, settings.bus.network.c_str());
    return kExitNoRun;
  }
  if (!settings.quiet) std::fprintf(stderr, "joined the run of scene '%s'\n", printable(run->scene_name).c_str());
  return Viewer(settings, *reader, *run).show();
}

}  // namespace presa
