#include "apps/common/options/bus_options.h"
#include "apps/common/options/view_options.h"
#include "apps/presa/commands/commands.h"
#include "apps/presa/remote/viewer.h"
#include "framework/core/diagnostics/refuse.h"

namespace presa {

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
  command.flag("--quiet", settings->quiet, "no status line");
  command.footer(
      "The picture is one period (5 ms) behind, interpolated. Without the bus it freezes and says so.\n"
      "Exit status: 0 shown, 1 it could not be drawn, 2 bad input or another scene, 3 no run within --wait, 130 "
      "Ctrl-C.\n"
      "Example:  presa run config/scenes/cube.xml --bus loopback &  presa view --join --view window");
  command.action([=, &status] {
    if (!*join)
      refuse(123, "presa view", "shows the run of another process, so it needs --join",
             "a scene in a window is presa run SCENE --view window");
    settings->bus = bus->value_or(BusSettings{});
    settings->view = chooseView(*view, true, !settings->screenshot.empty());
    Diagnostics diagnostics;
    settings->picture = pictureOf(*picture, {.view = settings->view, .screenshot = settings->screenshot}, diagnostics);
    if (diagnostics.hasErrors()) throw InputError(diagnostics);
    status = showRemote(*settings);
  });
}

}  // namespace presa
