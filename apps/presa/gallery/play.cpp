#include "apps/presa/gallery/play.h"

#include <algorithm>

#include "apps/common/atomic_file.h"
#include "apps/common/exit_status.h"
#include "apps/common/scratch_folder.h"
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

/// Writes the rig for mouse and keys to `file`. False: the scene has no finger.
bool writeMouseRig(const RunArguments& arguments, const std::string& file) {
  Diagnostics later;  // the run reports them
  const Scene scene = loadScene(arguments.inputs.scene, {}, later);
  if (scene.devices.empty()) return false;
  const Rig own = scene.default_rig.empty() ? Rig{} : loadRig(scene.default_rig, later);
  writeFileAtomically(file, mouseRig(scene, own));
  return true;
}

/// No end but the user's.
void leaveOpen(RunArguments& arguments) {
  arguments.traced = !arguments.report.empty();
  arguments.options.duration = arguments.traced ? kReported : kOpenEnd;
}

/// What only the first run has: its files, and its words at the terminal.
void forgetFiles(RunArguments& arguments) {
  RunOptions& options = arguments.options;
  for (std::string* file : {&options.record, &options.flight, &options.screenshot, &options.video, &arguments.summary,
                            &arguments.report, &arguments.inputs.rig})
    file->clear();
  options.screenshot_time = RunOptions{}.screenshot_time;
  arguments.inputs.sets.clear();
  arguments.quiet = true;
}

}  // namespace

int play(const std::vector<Entry>& entries, std::size_t first, bool by_hand, RunArguments arguments) {
  const ScratchFolder scratch;
  const bool repeats = !(arguments.options.duration > 0);
  SceneWish now{first, by_hand};
  for (int worst = kExitOk;;) {
    RunArguments run = arguments;
    run.inputs.scene = entries[now.scene].file;
    if (now.by_hand && run.inputs.rig.empty() && writeMouseRig(run, scratch.file("mouse.xml"))) {
      run.inputs.rig = scratch.file("mouse.xml");
      if (repeats) leaveOpen(run);
    }
    const bool windowed = viewOf(run) == RunOptions::View::kWindow;
    const RunEnd end = runScene(std::move(run), windowed ? offerOf(entries, now.scene) : SceneOffer{});
    worst = std::max(worst, end.status);
    if (!windowed || (!end.wish && !(end.complete && repeats))) return worst;
    if (end.wish) now = *end.wish;
    forgetFiles(arguments);
  }
}

}  // namespace presa::gallery
