#include <cstdio>
#include <memory>

#include "apps/common/options/bus_options.h"
#include "apps/common/scratch_folder.h"
#include "apps/presa/check/start_warnings.h"
#include "apps/presa/commands/commands.h"
#include "apps/presa/explain/cost.h"
#include "apps/presa/explain/description.h"
#include "apps/presa/explain/grasp.h"
#include "apps/presa/explain/printout.h"
#include "framework/core/diagnostics/printable.h"

namespace presa {
namespace {

struct ExplainArguments {
  Inputs inputs;
  std::string format = "text";
  bool cost = false;
  bool grasp = false;
  bool record = false;
  std::string view = "none";
  RunOptions bus;  ///< only what concerns the bus
};

/// Output files of the run go to `scratch`, because the user did not ask for them.
RunOptions optionsOf(const ExplainArguments& arguments, const ScratchFolder& scratch) {
  RunOptions options;
  options.bound_stiffness = true;
  options.bus = arguments.bus.bus;
  options.bus_commands = arguments.bus.bus_commands;
  options.guide = arguments.bus.guide;
  if (arguments.record) {
    options.record = scratch.file("run.h5");
    options.realtime = true;  // a recorder that waits for the disk would hide its cost per haptic tick
  }
  if (arguments.view == "window") options.view = RunOptions::View::kWindow;
  if (arguments.view == "offscreen") {
    options.view = RunOptions::View::kOffscreen;
    options.screenshot = scratch.file("picture.png");
    options.screenshot_time = 0;
  }
  return options;
}

int explain(const ExplainArguments& arguments) {
  const std::set<std::string> before = mappedLibraries();
  const ScratchFolder scratch;
  Diagnostics diagnostics;
  Loaded loaded = loadWorld(arguments.inputs, optionsOf(arguments, scratch), diagnostics);
  if (!diagnostics.hasErrors()) check::warnOfExplicitGrasps(*loaded.world, diagnostics);
  std::fputs(diagnostics.text().c_str(), stderr);
  if (diagnostics.hasErrors()) return kExitBadInput;
  if (arguments.grasp && arguments.format == "dot") {
    std::fputs("--format: error[E123]: --grasp prints text or json, found dot\n", stderr);
    return kExitBadInput;
  }
  if (arguments.grasp) return explainGrasp(std::move(loaded), arguments.format == "json");
  RunControl control;
  Session::Options options;
  options.open_devices = arguments.cost;
  Session session(std::move(loaded), control, std::move(options));
  nlohmann::json run = describeSession(session, before);
  if (arguments.cost) addCost(run, session);
  if (arguments.format == "json") {
    std::printf("%s\n", run.dump(2).c_str());
  } else {
    std::fputs(printableLines(arguments.format == "dot" ? explainDot(run) : explainText(run)).c_str(), stdout);
  }
  return kExitOk;
}

}  // namespace

void addExplain(Command app, int& status) {
  auto arguments = std::make_shared<ExplainArguments>();
  Command command =
      app.command("explain", "Show which parts a scene needs and why, what they cost, how good its grasp is");
  command.option("SCENE", arguments->inputs.scene, "scene file").required();
  command.option("--rig", arguments->inputs.rig, "rig file instead of the scene's own");
  command.option("--set", arguments->inputs.sets, "PATH=VALUE; may be repeated").oneValueEach();
  command.option("--format", arguments->format, "text, json or dot (for graphviz)").oneOf({"text", "json", "dot"});
  Option record =
      command.flag("--record", arguments->record, "explain a run that is recorded (to a file that is thrown away)");
  command.option("--view", arguments->view, "explain a run with this view: window, offscreen or none (default)")
      .oneOf({"window", "offscreen", "none"});
  addBusOptions(command, arguments->bus.bus, "explain a run that is published");
  addBusCommandsOption(command, arguments->bus.bus_commands);
  addGuideOption(command, arguments->bus);
  Option cost =
      command.flag("--cost", arguments->cost,
                   "play the scene with its devices (10 s of it at most) and tell for each module the wall time of\n"
                   "one step, median and p99.9, and the median's share of its thread's period");
  command
      .flag("--grasp", arguments->grasp,
            "play the scene to the end of its scripted hold and tell how good the grasp is: what the fingers resist,\n"
            "what least, and by how much the weight may grow before a finger slips (text or json)")
      .excludes(cost)
      .excludes(record);
  command.footer(
      "Examples:  presa explain config/scenes/cube.xml --cost\n"
      "           presa explain config/scenes/cube.xml --grasp\n"
      "           presa explain config/scenes/cube.xml --cost --record --view offscreen\n"
      "           presa explain config/scenes/cube.xml --format dot | dot -Tsvg > cube.svg");
  command.action([arguments, &status] { status = explain(*arguments); });
}

}  // namespace presa
