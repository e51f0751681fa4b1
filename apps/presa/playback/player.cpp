#include "apps/presa/playback/player.h"

#include <algorithm>
#include <cstdio>

#include "apps/common/exit_status.h"
#include "apps/common/joint_log.h"
#include "apps/common/terminal/interruption.h"
#include "apps/common/terminal/job_progress.h"
#include "apps/presa/playback/recorded_moment.h"
#include "framework/assembly/guide_module.h"
#include "framework/core/graph/graph_builder.h"
#include "framework/core/schedule/clock.h"
#include "framework/scene/joints/joint_positions.h"
#include "framework/session/session.h"

namespace presa {
namespace {

/// Writes the recorded states to the ports that a view reads. Runs in the view group, before the view.
class RecordedSource final : public Module {
 public:
  explicit RecordedSource(const RecordedMoment& moment) : Module("recording", RateGroup::kView), moment_(moment) {}
  void step(const Tick& tick) noexcept override {
    moment_.fill(tick.time, objects_.value, device_.value, contact_.value, command_.value);
  }

 private:
  const RecordedMoment& moment_;
  Out<ObjectState> objects_{*this, "object_state"};
  Out<DeviceState> device_{*this, "device_state"};
  Out<ContactExchange> contact_{*this, "contact_exchange"};
  Out<ForceCommand> command_{*this, "force_command"};
};

/// Writes the positions of the joints with the turns that they have made until then. Runs as RecordedSource.
class RecordedJoints final : public Module {
 public:
  RecordedJoints(const RecordedSamples& samples, const Scene& scene)
      : Module("recorded_joints", RateGroup::kView), log_(jointLogOf(samples, scene)) {
    positions_.value.of.resize(log_.positions().size());
  }
  void step(const Tick& tick) noexcept override {
    const std::vector<double>& times = log_.times();
    const auto later = std::ranges::upper_bound(times, tick.time) - times.begin();
    const auto row = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, later - 1));
    for (std::size_t p = 0; p < log_.positions().size(); ++p) positions_.value.of[p] = log_.positions()[p].samples[row];
  }

 private:
  const JointLog log_;
  Out<JointPositions> positions_{*this, kJointPositionsPort};
};

/// Writes the frames of the rig. Runs as RecordedSource.
class RecordedFrames final : public Module {
 public:
  explicit RecordedFrames(const RecordedMoment& moment) : Module("recorded_frames", RateGroup::kView), moment_(moment) {
    moment_.fillFrames(moment_.begin(), frames_.value);
  }
  void step(const Tick& tick) noexcept override { moment_.fillFrames(tick.time, frames_.value); }

 private:
  const RecordedMoment& moment_;
  Out<FrameState> frames_{*this, kFramesPort};
};

class Player {
 public:
  Player(const RecordedSamples& samples, const std::shared_ptr<const World>& world, const RunOptions& options,
         double speed)
      : world_(world), options_(options), moment_(samples, *world), time_(moment_.begin()) {
    time_control_.speed = speed;
    GraphBuilder builder;
    builder.add(std::make_unique<RecordedSource>(moment_));
    if (!world->scene.joints.empty()) builder.add(std::make_unique<RecordedJoints>(samples, world->scene));
    if (moment_.hasFrames()) builder.add(std::make_unique<RecordedFrames>(moment_));
    if (world->scene.assembly) builder.add(std::make_unique<GuideModule>(world));
    auto view = makeView(world, options);
    view_ = view.get();
    if (windowed()) view_->offerTime(time_control_, moment_.end());
    builder.add(std::move(view));
    builder.connectByName();
    graph_ = builder.build();
  }

  int run() {
    graph_.start(RateGroup::kView);
    windowed() ? live() : all();
    graph_.stop(RateGroup::kView);
    const View::Screenshot shot = view_->screenshot();
    if (shot.outcome != View::Screenshot::Outcome::kNotAsked) std::fprintf(stderr, "%s\n", shot.message.c_str());
    const std::string trouble = view_->videoTrouble();
    if (!trouble.empty()) std::fprintf(stderr, "no video %s: %s\n", options_.video.c_str(), trouble.c_str());
    return shot.outcome == View::Screenshot::Outcome::kFailed || !trouble.empty() ? kExitFault : kExitOk;
  }

 private:
  bool windowed() const { return options_.view == RunOptions::View::kWindow; }
  double period() const { return 1 / world_->scene.rates.view; }

  void step() {
    graph_.step(RateGroup::kView, {index_, time_, period()});
    ++index_;
  }
  /// Off-screen: draws the one wanted time, or all times for a video.
  void all() {
    if (options_.video.empty()) time_ = options_.screenshot_time < 0 ? moment_.end() : options_.screenshot_time;
    if (!options_.video.empty()) film();
    time_ = std::min(time_, moment_.end());
    step();
  }
  void film() {
    terminal::JobProgress progress(static_cast<std::size_t>((moment_.end() - time_) / period()) + 1);
    for (; time_ < moment_.end() && !progress.interrupted(); time_ += period()) {
      step();
      progress.done("pictures");
    }
  }
  void live() {
    std::int64_t last = monotonicNs();
    while (!view_->wantsStop() && !terminal::Interruption::came()) {
      step();
      sleepUntilNs(last + static_cast<std::int64_t>(period() * 1e9));
      const std::int64_t now = monotonicNs();
      advance(static_cast<double>(now - last) * 1e-9);
      last = now;
    }
  }
  void advance(double seconds) {
    if (const double moment = time_control_.jump_to.exchange(-1); moment >= 0)
      time_ = moment;
    else if (!time_control_.paused)
      time_ += time_control_.speed * seconds;
    if (const std::uint32_t steps = time_control_.steps; steps != steps_) {
      time_ += period() * (steps - steps_);
      steps_ = steps;
    }
    if (time_ >= moment_.end()) time_control_.paused = true;
    time_ = std::clamp(time_, moment_.begin(), moment_.end());
  }

  std::shared_ptr<const World> world_;
  const RunOptions& options_;
  RecordedMoment moment_;
  TimeControl time_control_;
  View* view_ = nullptr;  // owned by the graph
  Graph graph_;
  double time_;
  std::uint64_t index_ = 0;
  std::uint32_t steps_ = 0;
};

}  // namespace

int play(const RecordedSamples& samples, const std::shared_ptr<const World>& world, const RunOptions& options,
         double speed) {
  const terminal::Interruption interruption;
  return Player(samples, world, options, speed).run();
}

}  // namespace presa
