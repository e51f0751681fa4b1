#include "apps/presa/import/import_command.h"

#include <cstdio>
#include <memory>

#include "apps/common/exit_status.h"
#include "apps/common/replace_all.h"
#include "apps/common/scratch_folder.h"
#include "apps/common/terminal/waiting.h"
#include "apps/presa/check/start_warnings.h"
#include "apps/presa/import/import_robot.h"

namespace presa {
namespace {

/// Whether the scene loads, from a folder that nobody sees; prints what `presa check` says of it, as of the real one.
bool loads(const robot::Wanted& wanted, const robot::Imported& imported) {
  const ScratchFolder scratch;
  Diagnostics diagnostics;
  RunOptions options;
  options.bound_stiffness = true;
  const Loaded loaded = loadWorld({robot::write(scratch.path().string(), imported), "", {}}, options, diagnostics);
  if (!diagnostics.hasErrors()) check::warnOfStart(loaded, diagnostics);
  std::string text = diagnostics.text();
  replaceAll(text, scratch.path().string(), wanted.folder);
  std::fputs(text.c_str(), stderr);
  return !diagnostics.hasErrors();
}

int importFile(const robot::Wanted& wanted) {
  Diagnostics diagnostics;
  std::optional<robot::Imported> imported;
  robot::checkTarget(wanted, diagnostics);
  if (!diagnostics.hasErrors()) {
    const terminal::Waiting waiting("reading " + wanted.file);
    imported = robot::importRobot(wanted, diagnostics);
  }
  std::fputs(diagnostics.text().c_str(), stderr);
  if (!imported) return kExitBadInput;
  if (!loads(wanted, *imported)) {
    std::fputs("nothing is written: no scene can be made of this model\n", stderr);
    return kExitBadInput;
  }
  const std::string scene = robot::write(wanted.folder, *imported), left_out = robot::leftOutText(*imported);
  std::printf("%s\n", scene.c_str());
  if (!left_out.empty()) std::printf("left out or changed:\n%s", left_out.c_str());
  return kExitOk;
}

}  // namespace

void addImport(Command app, int& status) {
  auto wanted = std::make_shared<robot::Wanted>();
  Command command = app.command("import", "Make a scene from a robot or another model in URDF or MJCF");
  command.option("FILE", wanted->file, "URDF (<robot>) or MJCF (<mujoco>)").required().existingFile();
  command.option("--out", wanted->folder, "folder for the scene, its rig and its meshes").required();
  command.option("--stiffness", wanted->stiffness, "of all surfaces under a finger [N/m]").positive().showDefault();
  command.flag("--free-base", wanted->free_base, "the root link of a URDF moves freely; else it stands still");
  command.flag("--overwrite", wanted->overwrite, "replace files of before");
  command.footer(
      "Links become bodies with the masses and inertias of the file, and its joints become joints with limits, "
      "springs,\n"
      "damping and friction. Fingers feel what collides. The command lists all that the scene lacks.\n"
      "Exit status: 0 done, 2 bad input.\n"
      "Example:  presa import gripper.urdf --out gripper && presa run gripper/gripper.xml --view window");
  command.action([wanted, &status] { status = importFile(*wanted); });
}

}  // namespace presa
