#include "apps/presa/gallery/play.h"

#include <algorithm>

#include "apps/common/exit_status.h"
#include "apps/presa/gallery/groups.h"
#include "apps/presa/gallery/mouse_rig.h"
#include "framework/scene/load.h"

namespace presa::gallery {
namespace {

constexpr double kOpenEnd = 7 * 86400;  // of a scene in somebody's hands [s]
constexpr double kReported = 600;       // likewise, if a report keeps its samples [s]

SceneOffer offerOf(const std::vector<Entry>& entries, std::size_t now) {
  SceneOffer offer{{}, now};
  for (const Entry& entry : entries) offer.scenes.push_back({titleOf(entry.group), entry.name, entry.sentence});
  return offer;
}

/// The rig for mouse and keys. Empty: the scene has no finger.
std::string mouseRigOf(const std::string& file) {
  Diagnostics later;  // the run reports them
  const Scene scene = loadScene(file, {}, later);
  if (scene.devices.empty()) return {};
  return mouseRig(scene, scene.default_rig.empty() ? Rig{} : loadRig(scene.default_rig, later));
}

/// No end but the user's.
void leaveOpen(RunArguments& arguments) {
  arguments.traced = !arguments.report.empty();
  arguments.options.duration = arguments.traced ? kReported : kOpenEnd;
}

/// What only the first run has: its files, and its words at the terminal.
void forgetFiles(RunArguments& arguments) {
  RunOptions& options = arguments.options;
  for (std::string* file : {&options.record, &options.flight, &options.screenshot, &options.video, &options.sound,
                            &arguments.summary, &arguments.report})
    file->clear();
  options.screenshot_time = RunOptions{}.screenshot_time;
  arguments.picture.video_rate = PictureArguments{}.video_rate;
  arguments.quiet = true;
}

/// What was said of one scene and may not fit another one.
void forgetScene(RunArguments& arguments) {
  arguments.inputs.rig.clear();
  arguments.inputs.sets.clear();
  arguments.speed = 0;
}

}  // namespace

int play(const std::vector<Entry>& entries, std::size_t first, bool by_hand, RunArguments arguments) {
  const bool repeats = !(arguments.options.duration > 0);
  SceneWish now{first, by_hand};
  for (int worst = kExitOk;;) {
    RunArguments run = arguments;
    run.inputs.scene = entries[now.scene].file;
    if (now.by_hand && run.inputs.rig.empty()) run.inputs.rig_xml = mouseRigOf(run.inputs.scene);
    if (!run.inputs.rig_xml.empty() && repeats) leaveOpen(run);
    const bool windowed = viewOf(run) == RunOptions::View::kWindow;
    const RunEnd end = runScene(std::move(run), windowed ? offerOf(entries, now.scene) : SceneOffer{});
    worst = std::max(worst, end.status);
    const bool again = end.complete && repeats;
    if (!windowed || end.status == kExitInterrupted || !(end.wish || again)) return worst;
    if (end.wish) {
      now = *end.wish;
      forgetScene(arguments);
    }
    forgetFiles(arguments);
  }
}

}  // namespace presa::gallery
