#include "apps/presa/run/run_scene.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "apps/common/exit_status.h"
#include "apps/common/machine.h"
#include "apps/common/options/bus_options.h"
#include "apps/common/output_place.h"
#include "apps/common/report/report.h"
#include "apps/common/summary.h"
#include "apps/common/terminal/closing.h"
#include "apps/common/terminal/waiting.h"
#include "apps/common/terminal_run.h"
#include "framework/core/diagnostics/printable.h"
#include "framework/scene/xml/value_rule.h"

namespace presa {
namespace {

constexpr double kTraceRate = 250;  // samples per second for plots

void checkPlaces(const RunArguments& arguments, Diagnostics& diagnostics) {
  const RunOptions& options = arguments.options;
  for (const auto& [option, file] : {std::pair{"--record", options.record},
                                     {"--flight", options.flight},
                                     {"--screenshot", options.screenshot},
                                     {"--video", options.video},
                                     {"--sound", options.sound},
                                     {"--summary", arguments.summary},
                                     {"--report", arguments.report}}) {
    const std::string trouble = file.empty() ? "" : placeTrouble(file);
    if (!trouble.empty())
      diagnostics.error(124, {option, 0, 0}, "'" + printable(file) + "' cannot be written: " + trouble,
                        "name a file in a folder that you may write to; nothing was run");
  }
}

void checkOutputs(const RunArguments& arguments, Diagnostics& diagnostics) {
  for (const auto& [option, file] :
       {std::pair{"--screenshot", arguments.options.screenshot}, {"--video", arguments.options.video}}) {
    if (arguments.view == "none" && !file.empty())
      diagnostics.error(121, {option, 0, 0}, "a picture of the run needs a view, found --view none",
                        "use --view offscreen");
  }
}

/// Options that say nothing for this run, which would be ignored in silence.
void checkOptions(const RunArguments& arguments, const Loaded& loaded, Diagnostics& diagnostics) {
  const RunOptions& options = loaded.options;
  if (arguments.speed > 0 && options.realtime)
    diagnostics.error(123, {"--speed", 0, 0}, "only a run in virtual time has a speed, this one keeps to the clock",
                      "add --lockstep");
  if (!options.sound.empty() && !loaded.plan.has("sound"))
    diagnostics.error(123, {"--sound", 0, 0}, "nothing is heard in this scene, which has no <sound>",
                      "give it one, as in scenes/sounds.xml, or leave out --sound");
  if (options.screenshot_time < 0) return;
  std::array<char, 160> text;
  if (options.screenshot.empty()) {
    diagnostics.error(123, {"--screenshot-at", 0, 0}, "says when, but not where the picture goes",
                      "add --screenshot FILE.png");
  } else if (options.screenshot_time > options.duration) {
    std::snprintf(text.data(), text.size(), "the run ends at %g s, before the picture at %g s", options.duration,
                  options.screenshot_time);
    diagnostics.error(123, {"--screenshot-at", 0, 0}, text.data(), "name an earlier time, or a later end with --for");
  }
}

/// Nobody needs the clock: no person, no device, and no one who watches on the network.
bool modelsOnly(const Loaded& loaded) {
  const bool on_bus = loaded.options.bus && loaded.options.bus->network != "none";
  return !on_bus && !loaded.devices.empty() &&
         std::ranges::all_of(loaded.devices, [](const auto& device) { return !device->model().empty(); });
}

/// Without a closing text, a fault would leave no word.
void printFaults(const RunResult& result) {
  for (const RunResult::Fault& fault : result.faults)
    std::fprintf(stderr, "presa run: fault at %.3f s: %s\n", fault.time, printable(fault.text).c_str());
}

std::string commandLine(const RunArguments& a) {
  std::string line = "presa run " + a.inputs.scene;
  if (!a.inputs.rig.empty()) line += " --rig " + a.inputs.rig;
  line += a.options.realtime ? " --realtime" : " --lockstep";
  if (a.options.duration > 0) {
    std::array<char, 32> text;
    std::snprintf(text.data(), text.size(), " --for %g", a.options.duration);
    line += text.data();
  }
  for (const std::string& set : a.inputs.sets) line += " --set '" + set + "'";
  if (a.options.bus) line += " --bus " + a.options.bus->network;
  if (a.options.bus_commands) line += " --bus-commands";
  if (a.options.guide == RunOptions::Guide::kViewer) line += " --guide viewer";
  if (a.options.seed != 1) line += " --seed " + std::to_string(a.options.seed);
  return line;
}

int printPlugIns(const RunArguments& arguments, Diagnostics& diagnostics) {
  const auto names = plugInsFor(arguments.inputs, arguments.options, diagnostics);
  std::fputs(diagnostics.text().c_str(), stderr);
  for (const std::string& name : names) std::printf("%s\n", name.c_str());
  return diagnostics.hasErrors() ? kExitBadInput : kExitOk;
}

Loaded loadWith(const RunArguments& arguments, Diagnostics& diagnostics) {
  std::optional<terminal::Waiting> waiting;
  if (!arguments.quiet) waiting.emplace("loading " + arguments.inputs.scene);
  return loadWorld(arguments.inputs, arguments.options, diagnostics);
}

}  // namespace

void addRunOptions(Command command, RunArguments& arguments) {
  command.option("--rig", arguments.inputs.rig,
                 "rig file: the devices for the scene's roles (default: the rig that the scene names)");
  Option lockstep =
      command.flag("--lockstep", arguments.lockstep,
                   "virtual time on one thread: deterministic to the bit\n(default where models move every finger)");
  command
      .flag("--realtime", arguments.realtime,
            "one thread per rate, against the clock (default, unless models move every finger)")
      .excludes(lockstep);
  command
      .option("--for", arguments.options.duration,
              "simulated seconds (default: to the end of the scripted motion, else 10)")
      .positive();
  command.flag("--allow-no-rt", arguments.options.allow_no_rt,
               "let hardware run where the system refuses real-time scheduling: with half the force");
  command.option("--seed", arguments.options.seed, "seed of every random stream");
  command
      .option("--set", arguments.inputs.sets,
              "PATH=VALUE: change any value of the scene, e.g. body/cube/physics/mass=0.1,\n"
              "material/rubber/stiffness=2000, rates/dynamics=400; may be repeated")
      .oneValueEach();
  command
      .option("--memory", arguments.memory,
              "MiB that distance fields of tools may take: larger ones are refused before they are built\n"
              "(the same as --set 'haptics/*/memory=MIB')")
      .positive();
  command.option("--record", arguments.options.record, "record the run at haptic rate (HDF5)");
  command.option("--flight", arguments.options.flight,
                 "keep the last two seconds in memory and write them here when a fault occurs\n"
                 "(default with real devices: flight-TIME.h5; presa replay opens it)");
  command.flag("--overwrite", arguments.options.overwrite, "let --record replace an existing file");
  command.option("--view", arguments.view, "window, offscreen or none (default: window when there is a display)")
      .oneOf({"window", "offscreen", "none"});
  command.option("--screenshot", arguments.options.screenshot,
                 "PNG of the scene, at the middle of the hold when there is one");
  command.option("--screenshot-at", arguments.options.screenshot_time, "simulated time of the screenshot [s]")
      .nonNegative();
  command.option("--video", arguments.options.video, "MP4 of the run through ffmpeg");
  command.option("--sound", arguments.options.sound,
                 "WAV of what a scene with <sound> sounds like, from the start of the run, half an hour at most");
  command
      .option(
          "--speed", arguments.speed,
          "simulated seconds in a second, of a lockstep run (default: with a window 1, where the keys [ and ] change\n"
          "it; without as many as the machine makes)")
      .positive();
  addVideoRate(command, arguments.picture);
  addPictureOptions(command, arguments.picture, arguments.options.show);
  addBusOptions(command, arguments.options.bus, "publish the state for presa view --join");
  addBusCommandsOption(command, arguments.options.bus_commands);
  addGuideOption(command, arguments.options);
  command.option("--summary", arguments.summary, "results as JSON");
  command.option("--report", arguments.report, "results as one HTML page with plots");
  command.flag("--plug-ins", arguments.plug_ins, "print the plug-ins that this run would load, and run nothing");
  command.flag("--quiet", arguments.quiet, "no status line and no closing text");
}

RunOptions::View viewOf(const RunArguments& arguments) {
  return chooseView(arguments.view, !arguments.lockstep,
                    !arguments.options.screenshot.empty() || !arguments.options.video.empty());
}

RunEnd runScene(RunArguments arguments, SceneOffer offer) {
  arguments.options.realtime = !arguments.lockstep;
  if (arguments.memory > 0) arguments.inputs.sets.push_back("haptics/*/memory=" + xml::numberText(arguments.memory));
  arguments.options.bound_stiffness = true;
  arguments.options.view = viewOf(arguments);
  std::string now = utcNow();
  std::erase_if(now, [](char c) { return c == '-' || c == ':'; });
  arguments.options.hardware_flight = "flight-" + now + ".h5";

  Diagnostics diagnostics;
  if (arguments.plug_ins) return {.status = printPlugIns(arguments, diagnostics)};
  arguments.options.picture = pictureOf(arguments.picture, arguments.options, diagnostics);
  Loaded loaded = loadWith(arguments, diagnostics);
  if (!arguments.realtime && modelsOnly(loaded)) arguments.options.realtime = loaded.options.realtime = false;
  if (!diagnostics.hasErrors()) checkOutputs(arguments, diagnostics);
  if (!diagnostics.hasErrors()) checkOptions(arguments, loaded, diagnostics);
  if (!diagnostics.hasErrors()) checkPlaces(arguments, diagnostics);
  checkBusCommands(arguments.options.bus_commands, loaded.options, diagnostics);
  std::fputs(diagnostics.text().c_str(), stderr);
  if (diagnostics.hasErrors()) return {.status = kExitBadInput};

  TerminalRun run(std::move(loaded), {.trace_rate = arguments.traced ? kTraceRate : 0,
                                      .quiet = arguments.quiet,
                                      .command = commandLine(arguments),
                                      .found = std::move(diagnostics),
                                      .speed = arguments.speed > 0 ? arguments.speed : 1,
                                      .paced = arguments.speed > 0,
                                      .scenes = std::move(offer.scenes),
                                      .scene = offer.now});
  run.execute();
  const RunResult& result = run.result();
  if (!arguments.summary.empty()) writeSummary(result, arguments.summary);
  if (!arguments.report.empty()) writeReport(result, arguments.report);
  if (!arguments.quiet) printClosing(result, arguments.summary, arguments.report);
  if (arguments.quiet) printFaults(result);
  const int status = result.interrupted ? kExitInterrupted : result.faults.empty() ? kExitOk : kExitFault;
  return {.status = status, .complete = status == kExitOk && !run.stopped(), .wish = run.wish()};
}

}  // namespace presa
