#include <cstdio>
#include <memory>

#include "apps/common/atomic_file.h"
#include "apps/common/joint_words.h"
#include "apps/common/losses.h"
#include "apps/common/options/view_options.h"
#include "apps/common/report/recording_page.h"
#include "apps/presa/commands/commands.h"
#include "apps/presa/playback/player.h"
#include "apps/presa/replay_page/replay_page.h"
#include "apps/presa/replay_page/three_js.h"
#include "framework/core/diagnostics/printable.h"
#include "framework/record/record_plugin.h"
#include "framework/scene/joints/joint_words.h"
#include "framework/session/load_world.h"
#include "framework/session/replay.h"

namespace presa {
namespace {

struct ReplayArguments {
  std::string file, page, view;
  RunOptions shown;  ///< options of the view
  PictureArguments picture;
  double speed = 1;
  bool verify = false;
};

/// A window only if the user asks for one.
RunOptions::View viewOf(const ReplayArguments& arguments) {
  return chooseView(arguments.view, false, !arguments.shown.screenshot.empty() || !arguments.shown.video.empty());
}

int showRecording(const ReplayArguments& arguments, const Recording& recording, const RecordedSamples& samples) {
  Diagnostics diagnostics;
  RunOptions options = arguments.shown;
  options.bus = BusSettings{.network = "none"};
  const Loaded loaded =
      loadWithoutDevices({recording.scene_xml, recording.scene_file, recording.rig_xml}, options, diagnostics);
  std::fputs(diagnostics.text().c_str(), stderr);
  return diagnostics.hasErrors() ? kExitBadInput : play(samples, loaded.world, loaded.options, arguments.speed);
}

void printFaults(const std::vector<std::string>& faults) {
  for (const std::string& fault : faults) std::printf("  fault at %s\n", printable(fault).c_str());
}

/// Prints whether the recording is complete and unchanged.
void printProvenance(const Recording& recording) {
  if (!recording.complete)
    std::printf(
        "  the run was killed: the recording has no checksum and ends at its last flush; %llu ticks after it are left "
        "out\n",
        static_cast<unsigned long long>(recording.left_out));
  else if (!recording.checksum)
    std::printf("  no checksum: its format is older than checksums, so a later change is not detected\n");
}

void printHeader(const std::string& file, const Recording& recording) {
  std::printf("%s: scene %s, %zu haptic ticks, %.3f s, seed %llu, %s, %s%s\n", file.c_str(),
              printable(recording.scene_file).c_str(), recording.time.size(),
              recording.time.back() + recording.haptic_period, static_cast<unsigned long long>(recording.seed),
              recording.realtime ? "real time" : "lockstep", recording.checksum ? "checksum right" : "no checksum",
              recording.dropped > 0 ? ", INCOMPLETE" : "");
  printProvenance(recording);
  if (recording.guided)
    std::printf("  the guide of the assembly was in a viewer: %zu orders\n", recording.orders.size());
  const auto stop =
      std::ranges::find_if(recording.device, [](const DeviceState& state) { return state.stop_requested; });
  if (stop != recording.device.end()) std::printf("  stopped by the user at %.3f s; then forces faded\n", stop->time);
}

int printVerdict(const ReplayResult& result) {
  const auto ticks = static_cast<unsigned long long>(result.ticks);
  if (result.differing > 0) {
    std::printf("NOT the same: %llu ticks differ, first at %.3f s, by up to %.3g N\n",
                static_cast<unsigned long long>(result.differing), result.first_difference, result.largest_difference);
    return kExitFault;
  }
  if (result.verified()) {
    std::printf(
        "verified: %llu ticks of %zu finger%s, all of the recording: every commanded force is the same to the bit\n",
        ticks, result.fingers, result.fingers == 1 ? "" : "s");
    return kExitOk;
  }
  if (result.fingers == 0) {
    std::printf("nothing to compare: the scene has no finger, so no force was commanded\n");
    return kExitOk;
  }
  std::printf("NOT verified: %llu of %llu ticks could be run again; these are the same to the bit\n", ticks,
              static_cast<unsigned long long>(result.recorded));
  return kExitFault;
}

/// Haptic losses of the run occur in its replay as well.
void printLosses(const RecordedRun& run) {
  RunResult result;
  result.world = run.world();
  takeMonitor(run.monitor(), result);
  for (const std::string& loss : lossesOf(result)) std::printf("  warning: %s\n", loss.c_str());
}

/// Where the joints were, from the recorded poses; nothing in a scene without joints.
void printJoints(const RecordedSamples& samples, const Scene& scene) {
  const JointLog log = jointLogOf(samples, scene);
  for (const JointLog::Position& position : log.positions()) {
    const Joint& joint = log.jointOf(position);
    const auto text = [&](double value) { return positionText(joint, position.axis, value); };
    std::printf("  joint %s: %s at the end, %s to %s\n", printable(positionName(joint, position.axis)).c_str(),
                text(position.travel.end).c_str(), text(position.travel.min).c_str(),
                text(position.travel.max).c_str());
  }
}

/// A recording of the seconds around a fault: it begins in the middle of a run and can be shown but not replayed.
int showFlight(const std::string& file, const RecordedSamples& samples) {
  std::printf("%s: %.3f to %.3f s of scene %s, around a fault\n", file.c_str(), samples.time.front(),
              samples.time.back(), printable(samples.scene_file).c_str());
  printFaults(samples.faults);
  std::printf("output stages of all fingers together\n");
  for (const std::string& line : statusTimeline(samples)) std::printf("  %s\n", line.c_str());
  std::printf("forces and motion, in 3-D: presa replay %s --page FILE.html\n", file.c_str());
  return kExitOk;
}

int runReplay(ReplayArguments arguments) {
  Diagnostics asked;
  arguments.shown.view = viewOf(arguments);
  arguments.shown.picture = pictureOf(arguments.picture, arguments.shown, asked);
  if (asked.hasErrors()) throw InputError(asked);
  std::string three_js;
  if (!arguments.page.empty()) {  // before a long recording is read
    replay_page::checkPlace(arguments.page);
    three_js = replay_page::threeJs();
  }
  const Recording recording = recordPlugin().read(arguments.file);
  const bool shown = arguments.shown.view != RunOptions::View::kNone;
  if (recording.first_tick > 0 || !arguments.page.empty() || shown) {
    const RecordedSamples samples = recordPlugin().samples(arguments.file);
    if (!arguments.page.empty()) writeFileAtomically(arguments.page, replay_page::page(recording, samples, three_js));
    if (shown) {
      const int status = showRecording(arguments, recording, samples);
      if (status != kExitOk || !arguments.verify) return status;
    }
    if (recording.first_tick > 0) return showFlight(arguments.file, samples);
  }
  printHeader(arguments.file, recording);
  printFaults(recording.faults);
  if (recording.dropped > 0) {
    std::fprintf(stderr,
                 "%s: error[E610]: %llu rows were dropped while recording, so the run cannot be repeated exactly\n",
                 arguments.file.c_str(), static_cast<unsigned long long>(recording.dropped));
    return kExitFault;
  }
  Diagnostics diagnostics;
  RecordedRun run(recording, diagnostics);
  std::fputs(diagnostics.text().c_str(), stderr);
  if (diagnostics.hasErrors()) return kExitBadInput;

  const ReplayResult result = run.run();
  if (!result.problem.empty()) {
    std::fprintf(stderr, "%s: error[E611]: %s\n", arguments.file.c_str(), result.problem.c_str());
    return kExitFault;
  }
  std::printf("replayed %llu ticks, state hash 0x%016llx\n", static_cast<unsigned long long>(result.ticks),
              static_cast<unsigned long long>(run.stateHash()));
  printLosses(run);
  const Scene& scene = run.world()->scene;
  if (!scene.joints.empty()) printJoints(recordPlugin().samples(arguments.file), scene);
  return arguments.verify ? printVerdict(result) : kExitOk;
}

}  // namespace

void addReplay(Command app, int& status) {
  auto arguments = std::make_shared<ReplayArguments>();
  Command command = app.command("replay", "Run a recording again from its device input, or show the record of a fault");
  command.option("FILE", arguments->file, "recording made with presa run --record, or the record of a fault (--flight)")
      .required();
  command.flag("--verify", arguments->verify, "compare every commanded force with the recorded one, bit by bit");
  command.option("--view", arguments->view, "window: play, pause and seek; offscreen: with --screenshot or --video")
      .oneOf({"window", "offscreen"});
  command.option("--speed", arguments->speed, "seconds of the recording in a second of the window (default 1)")
      .positive();
  command.option("--screenshot", arguments->shown.screenshot, "PNG of one moment");
  command.option("--screenshot-at", arguments->shown.screenshot_time, "which moment [s] (default: the end)");
  command.option("--video", arguments->shown.video, "MP4 of all of it, through ffmpeg");
  addVideoRate(command, arguments->picture);
  addPictureOptions(command, arguments->picture, arguments->shown.show);
  command.option("--page", arguments->page,
                 "one HTML page: the motion in 3-D and its plots under one time scrubber; opens offline (libjs-three)");
  command.footer(
      "Nothing is run again for a view: it shows what was recorded.\nExit status: 0 replayed (and, with --verify, "
      "equal), 1 different, 2 not a recording.");
  command.action([arguments, &status] { status = runReplay(*arguments); });
}

}  // namespace presa
