#include <algorithm>

#include "apps/common/options/bus_options.h"
#include "apps/common/options/view_options.h"
#include "apps/presa/commands/commands.h"
#include "apps/presa/remote/viewer.h"
#include "framework/core/diagnostics/refuse.h"

namespace presa {

namespace {

/// Options that say nothing without others, or on a wall.
void checkCave(const Command& command, const CaveSettings& cave) {
  const auto given = [&](const char* option) { return command.given(option); };
  if (cave.walls.empty()) {
    for (const char* option : {"--wall", "--head", "--stereo"})
      if (given(option)) refuse(123, option, "says nothing without --walls", "--walls config/cave/cave.xml");
    return;
  }
  if (cave.wall.empty() && cave.head.empty())
    refuse(123, "--walls", "needs --wall NAME, --head RIG, or both", "a process draws one wall, or leads the others");
  for (const char* option : {"--stereo", "--screenshot"})
    if (cave.wall.empty() && given(option)) refuse(123, option, "says nothing without --wall");
  for (const char* option : {"--camera", "--picture-size", "--hud", "--legend", "--background"})
    if (given(option))
      refuse(123, option, "says nothing on a wall: the head is the camera, the file of the walls has their sizes");
}

}  // namespace

void addView(Command app, int& status) {
  auto settings = std::make_shared<ViewerSettings>();
  auto bus = std::make_shared<std::optional<BusSettings>>();
  auto join = std::make_shared<bool>(false);
  auto view = std::make_shared<std::string>();
  auto picture = std::make_shared<PictureArguments>();
  Command command = app.command("view", "Show a run that another process, or another machine, publishes");
  command.flag("--join", *join, "join the run on the bus (presa run SCENE --bus loopback); required");
  command.option("SCENE", settings->scene,
                 "scene file to draw, where its meshes lie elsewhere on this machine; it is compared with the run's");
  addBusOptions(command, *bus, "the network that the run is on");
  command.option("--wait", settings->wait, "seconds to wait for a run").nonNegative().showDefault();
  command.option("--for", settings->duration, "seconds to show it (default: to the end of the run)").positive();
  command.option("--view", *view, "window, offscreen or none (default: window when there is a display)")
      .oneOf({"window", "offscreen", "none"});
  command.option("--screenshot", settings->screenshot, "PNG of what is shown");
  command.option("--screenshot-at", settings->screenshot_time,
                 "simulated time of the run for it [s] (default: when the viewer ends)");
  addMeshesOption(command, settings->meshes);
  addPictureOptions(command, *picture, settings->show);
  auto stereo = std::make_shared<std::string>("mono");
  command
      .option("--walls", settings->cave.walls,
              "walls of a CAVE (config/cave/cave.xml), of which this process draws one, leads all, or both")
      .existingFile();
  command.option("--wall", settings->cave.wall, "name of the wall to draw, from the head instead of a camera");
  command
      .option("--head", settings->cave.head,
              "rig of the tracked head, or of a motion in its place (config/cave/head.xml): this process leads, the\n"
              "others draw the frames that it announces, all of them the same one")
      .existingFile();
  command
      .option("--stereo", *stereo,
              "pictures for both eyes on the wall; quad: one picture where the driver has no such buffers")
      .oneOf({walls::kStereoNames.begin(), walls::kStereoNames.end()})
      .showDefault();
  command.flag(
      "--guide", settings->guide,
      "guide the assembly of the run (presa run SCENE --bus-commands --guide viewer): this viewer chooses which "
      "body\nis pulled to which goal and tells the user what to do");
  command.flag("--quiet", settings->quiet, "no status line");
  command.footer(
      "The picture is one period (5 ms) behind, interpolated. Without the bus it freezes and says so.\n"
      "Exit status: 0 shown, 1 it could not be drawn, 2 bad input or another scene, 3 no run within --wait, 130 "
      "Ctrl-C.\n"
      "Example:  presa run config/scenes/cube.xml --bus loopback &  presa view --join --view window\n"
      "A guide at the screen:  presa temple --bus loopback --bus-commands --guide viewer, and here  presa view --join "
      "--guide\n"
      "A CAVE, a process for each wall and one for the head:  presa view --join --walls config/cave/cave.xml --wall "
      "front\n"
      "                                 presa view --join --walls config/cave/cave.xml --head config/cave/head.xml");
  command.action([=, &status] {
    if (!*join)
      refuse(123, "presa view", "shows the run of another process, so it needs --join",
             "a scene in a window is presa run SCENE --view window");
    settings->bus = bus->value_or(BusSettings{});
    checkCave(command, settings->cave);
    settings->cave.stereo =
        static_cast<walls::Stereo>(std::ranges::find(walls::kStereoNames, *stereo) - walls::kStereoNames.begin());
    const bool draws = settings->cave.walls.empty() || !settings->cave.wall.empty();
    settings->view = draws ? chooseView(*view, true, !settings->screenshot.empty()) : RunOptions::View::kNone;
    Diagnostics diagnostics;
    settings->picture = pictureOf(*picture, {.view = settings->view, .screenshot = settings->screenshot}, diagnostics);
    if (diagnostics.hasErrors()) throw InputError(diagnostics);
    status = showRemote(*settings);
  });
}

}  // namespace presa
