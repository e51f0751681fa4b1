#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <numbers>
#include <tuple>

#include "apps/common/atomic_file.h"
#include "apps/common/exit_status.h"
#include "apps/common/options/bus_options.h"
#include "apps/common/options/command_line.h"
#include "apps/common/options/view_options.h"
#include "apps/common/scratch_folder.h"
#include "apps/common/terminal/job_progress.h"
#include "apps/common/terminal/waiting.h"
#include "apps/common/terminal_run.h"
#include "apps/temple/building/building.h"
#include "apps/temple/building/words.h"
#include "apps/temple/models/block_models.h"
#include "apps/temple/ruins.h"
#include "apps/temple/ruins_cache.h"
#include "apps/temple/visit.h"
#include "apps/temple/visit_counts.h"
#include "apps/temple/voice.h"
#include "apps/temple/written_scene.h"
#include "framework/core/diagnostics/printable.h"
#include "framework/input/on_path.h"
#include "framework/sound/loudspeaker.h"

namespace presa {
namespace {

constexpr double kBehind = 0.1;          // distance of the building's centre behind that of the field [m]
constexpr double kEachBlock = 100;       // time limit of an automatic rebuilding, per block [s]
constexpr double kPictureAfter = 0.005;  // one step of the dynamics [s]
constexpr double kLetGo = 2;             // time to let go, once all blocks are placed [s]
constexpr double kFinish = 42;           // time to show the result to spectators: once round it [s]
constexpr double kOpenEnd = 7 * 86400;   // [s]

struct Arguments {
  std::string size, parameters, folder, rig, view, screenshot, video, summary, language = "en", plan = "vitruvius",
                                                                               sound_file;
  std::vector<std::string> show;  // as in RunOptions
  PictureArguments asked;
  RunOptions bus;                        // only what concerns the bus
  std::string visits;                    // folder of saved visits; empty: the default
  std::string counts;                    // file of counted visits; empty: the default
  std::string models;                    // folder; empty: none
  std::string kept;                      // session to continue
  std::vector<std::string> screenshots;  // seconds, folder
  std::uint64_t seed = 1;
  double limit = 0;         // simulated [s]; 0: by the number of blocks, or unlimited
  double time_scale = 0;    // simulated seconds per wall-clock second; 0: none
  double attract = 0;       // [s]; 0: never
  bool attracting = false;  // no visitor came during the previous ruins
  bool no_help = false, voice = false, quiet = false, one_task = false, show_counts = false, sound = false;
  bool painted = false, tenon = false;
  bool assembled = false, overwrite = false, automatic = false, lockstep = false, go_on = false, allow_no_rt = false;

  /// True when the building is to be assembled, rather than only drawn or written.
  bool visit() const {
    return automatic || go_on || attract > 0 || limit > 0 || time_scale > 0 || !screenshots.empty() || !video.empty() ||
           (folder.empty() && screenshot.empty());
  }
  /// True when somebody with a mouse is to rebuild it.
  bool anybody() const { return visit() && !automatic && rig.empty() && !go_on; }
  bool realtime() const { return !lockstep && time_scale == 0; }
};

RunOptions::View viewOf(const Arguments& a) {
  return chooseView(a.view, !a.lockstep, !a.screenshot.empty() || !a.screenshots.empty() || !a.video.empty());
}

std::string visitFolder(const Arguments& a) {
  if (a.visits == "none" || (a.visits.empty() && !a.realtime())) return {};
  return a.visits.empty() ? temple::defaultVisitFolder() : a.visits;
}

std::string countsFile(const Arguments& a) {
  if (a.counts == "none" || (a.counts.empty() && (!a.realtime() || a.automatic))) return {};
  return a.counts.empty() ? temple::defaultCountsFile() : a.counts;
}

/// A visitor at a window hears the stones where there is something to play them.
bool soundByItself(const Arguments& a) {
  return a.anybody() && !a.quiet && a.sound_file.empty() && viewOf(a) == RunOptions::View::kWindow &&
         sound::Loudspeaker::available();
}

/// What follows a task: all are offered in turn. Empty: nothing.
std::string nextTask(const Arguments& a) {
  const std::vector<std::string> tasks = temple::shippedNames();
  const auto now = std::ranges::find(tasks, a.size);
  if (a.one_task || a.automatic || !a.parameters.empty() || now == tasks.end()) return {};
  return now + 1 == tasks.end() ? tasks.front() : *(now + 1);
}

/// A picture of the scene alone is drawn off-screen.
PictureOptions pictureOf(const Arguments& a, Diagnostics& diagnostics) {
  RunOptions options;
  options.view = a.visit() ? viewOf(a) : RunOptions::View::kOffscreen;
  options.screenshot = a.screenshot;
  options.video = a.video;
  return pictureOf(a.asked, options, diagnostics);
}

void checkOutputs(const Arguments& a, Diagnostics& diagnostics) {
  pictureOf(a, diagnostics);
  if (a.voice) temple::Voice::check(diagnostics);
  if (a.sound && !input::isOnPath(sound::Loudspeaker::kPlayer))
    diagnostics.error(963, {"--sound", 0, 0}, "sounds are played by aplay, which is not on the PATH",
                      "install it (Debian: alsa-utils), or leave out --sound");
  if (a.visit() && !a.automatic && a.rig.empty() && viewOf(a) != RunOptions::View::kWindow)
    diagnostics.error(
        979, {"command line", 0, 0}, "there is nobody to rebuild it: no window for a visitor, and no rig",
        "set DISPLAY for a window, --rig RIG for devices, --auto for simulated fingers; --write DIR writes the "
        "scene, --screenshot FILE.png shows it");
  if (!a.folder.empty()) temple::checkTarget(a.folder, a.overwrite, diagnostics);
  if (a.view == "none" && !(a.screenshot.empty() && a.screenshots.empty() && a.video.empty()))
    diagnostics.error(121, {"--screenshot", 0, 0}, "a screenshot needs a view, found --view none",
                      "use --view offscreen");
  if (!a.screenshots.empty() && !(std::atof(a.screenshots.front().c_str()) > 0))
    diagnostics.error(123, {"--screenshot-every", 0, 0},
                      "a picture every '" + a.screenshots.front() + "' seconds cannot be taken",
                      "--screenshot-every 0.5 out/pictures");
}

/// The pose of each block in the ruins, with progress; empty when interrupted.
std::vector<Pose> strew(const temple::Building& building, std::uint64_t seed) {
  const ScratchFolder scratch;
  // one job per block, and a last one: all settle together
  terminal::JobProgress progress(building.blocks.size() + 1);
  std::size_t reported = 0;
  const auto tell = [&](std::size_t lying, std::size_t, const std::string& what) {
    for (; reported < lying; ++reported) progress.done(what);
    progress.show();
    return !terminal::JobProgress::interrupted();
  };
  return temple::strewRuins(building, seed, scratch.path().string(), tell).X_WB;
}

/// The scene of the ruins; `shipped`: name of a shipped building, else empty. No value when interrupted.
std::optional<temple::SceneSpec> ruinsOf(const temple::Building& building, std::uint64_t seed,
                                         const std::string& shipped) {
  std::optional<std::vector<Pose>> X_WB = temple::shippedRuins(shipped, seed);
  const std::string kept = X_WB ? std::string() : temple::ruinsCacheFile(building, seed);
  if (!X_WB) X_WB = temple::readRuins(kept, building);
  if (!X_WB) {
    X_WB = strew(building, seed);
    if (X_WB->empty()) return std::nullopt;
    temple::keepRuins(kept, building, seed, *X_WB);
  }
  temple::SceneSpec spec = temple::assembled(building);
  spec.name += "_ruins";
  spec.description = "What is left of a Doric building";
  for (temple::SceneSpec::Stone& stone : spec.stones) stone.X_WB = (*X_WB)[stone.block];
  return spec;
}

int takePicture(const temple::Building& building, temple::SceneSpec spec, const Arguments& a) {
  const ScratchFolder scratch;
  spec.rig.clear();
  RunOptions options;
  options.duration = kPictureAfter;
  options.view = RunOptions::View::kOffscreen;
  options.show = a.show;
  options.screenshot = a.screenshot;
  Diagnostics diagnostics;
  options.picture = pictureOf(a, diagnostics);
  // A building that nobody rebuilds has no words for visitors; an engineer's figures are not for its picture.
  if (!spec.to_be_built && options.picture.hud == PictureOptions::Hud::kFull)
    options.picture.hud = PictureOptions::Hud::kOff;
  if (const auto folder = std::filesystem::path(a.screenshot).parent_path(); !folder.empty())
    std::filesystem::create_directories(folder);
  Loaded loaded =
      loadWorld({temple::writeScene(building, spec, scratch.path().string()), "", {}}, options, diagnostics);
  std::fputs(diagnostics.text().c_str(), stderr);
  if (diagnostics.hasErrors()) return kExitBadInput;
  TerminalRun run(std::move(loaded), {.quiet = true, .command = "presa temple"});
  run.execute();
  for (const auto& fault : run.result().faults) std::fprintf(stderr, "%s\n", printable(fault.text).c_str());
  if (!run.result().faults.empty()) return kExitFault;
  std::printf("%s\n", a.screenshot.c_str());
  return run.result().interrupted ? kExitInterrupted : kExitOk;
}

std::string pairOf(const char* driver) {
  const auto device = [&](const char* role) {
    return std::string("<device role=\"") + role + "\" driver=\"" + driver + "\"/>";
  };
  return std::string("<rig version=\"1.0\" name=\"") + driver + "_pair\">" + device("thumb") + device("index") +
         "</rig>";
}

RunOptions optionsOf(const temple::Building& building, const Arguments& a, Diagnostics& diagnostics) {
  RunOptions options;
  options.duration = a.limit > 0   ? a.limit
                     : a.automatic ? kEachBlock * static_cast<double>(building.blocks.size())
                                   : kOpenEnd;
  if (!a.rig.empty()) options.seed = a.seed;  // random numbers of the rig's fingers; the ruins have their own
  options.realtime = a.realtime();
  options.allow_no_rt = a.allow_no_rt;
  options.bound_stiffness = !a.automatic;
  options.bus = a.bus.bus;
  options.bus_commands = a.bus.bus_commands;
  options.guide = a.bus.guide;
  options.view = viewOf(a);
  options.screenshot = a.screenshot;
  options.video = a.video;
  options.show = a.show;
  options.picture = pictureOf(a, diagnostics);
  if (!a.screenshots.empty()) {
    options.screenshot_every = std::atof(a.screenshots.front().c_str());
    options.screenshots = a.screenshots.back();
    std::filesystem::create_directories(options.screenshots);
  }
  return options;
}

int reportRebuild(const temple::Rebuilt& rebuilt, const Arguments& a) {
  if (!a.summary.empty()) writeFileAtomically(a.summary, temple::summaryText(rebuilt, a.size, a.seed));
  std::printf(
      "%d of %d blocks in their places, at most %.3f mm and %.2f degrees off; %d dropped, %d lost; %.0f s simulated in "
      "%.1f s\n",
      rebuilt.placed, rebuilt.pieces, 1e3 * rebuilt.worst_position_error,
      rebuilt.worst_angle_error * 180 / std::numbers::pi, rebuilt.drops, rebuilt.lost, rebuilt.simulated_seconds,
      rebuilt.wall_seconds);
  if (rebuilt.interrupted) return kExitInterrupted;
  const bool done = rebuilt.placed == rebuilt.pieces || !a.automatic;
  return done && rebuilt.lost == 0 && rebuilt.faults == 0 ? kExitOk : kExitFault;
}

temple::VisitEnd runVisit(const temple::Building& building, temple::SceneSpec spec, const Arguments& a,
                          const temple::Proportions& proportions, temple::KeptSession start) {
  const ScratchFolder scratch;
  if (spec.rig.empty()) {
    spec.rig = scratch.file("pair.xml");
    writeFileAtomically(spec.rig, pairOf(a.automatic ? "assembling_hand" : "pointer"));
  }
  Diagnostics diagnostics;
  Loaded loaded = loadWorld({temple::writeScene(building, spec, scratch.path().string()), "", {}},
                            optionsOf(building, a, diagnostics), diagnostics);
  checkBusCommands(a.bus.bus_commands, loaded.options, diagnostics);
  if (diagnostics.hasErrors()) throw InputError(diagnostics);
  std::fputs(diagnostics.text().c_str(), stderr);

  temple::VisitSettings settings{
      .finish = !a.automatic   ? -1
                : a.realtime() ? kFinish
                               : kLetGo,
      .time_scale = a.time_scale,
      .quiet = a.lockstep || a.quiet,
      .attract = a.automatic ? 0 : a.attract,
      .attracting = a.attracting,
      .folder = visitFolder(a),
      .start = std::move(start),
      .language = a.language,
      .voice = a.voice,
      .sound = a.sound || soundByItself(a),
      .sound_file = a.sound_file,
      .density = proportions.stone.density,
      .full_size = proportions.full_size > 0 ? proportions.full_size / proportions.module : 1,
      .counts = countsFile(a),
      .task = temple::taskWords(a.language, a.size),
      .next = temple::taskWords(a.language, nextTask(a)),
      .help = !a.no_help};
  if (!a.lockstep) return temple::visit(std::move(loaded), settings);
  terminal::JobProgress progress(building.blocks.size());
  int done = 0;
  settings.progress = [&](int placed, int) {
    for (; done < placed; ++done) progress.done("rebuilding");
    progress.show();
    return true;
  };
  return temple::visit(std::move(loaded), settings);
}

/// The scene with the block poses of a saved visit.
std::optional<temple::SceneSpec> specOf(const temple::Building& building, const temple::KeptSession& kept,
                                        const std::string& file, Diagnostics& diagnostics) {
  if (kept.X_WB.size() != building.blocks.size()) {
    diagnostics.error(967, {file, 0, 0},
                      "the session has " + std::to_string(kept.X_WB.size()) + " blocks, the building " +
                          std::to_string(building.blocks.size()),
                      "the building of the session: --parameters has to be the same");
    return std::nullopt;
  }
  temple::SceneSpec spec = temple::assembled(building);
  for (temple::SceneSpec::Stone& stone : spec.stones) stone.X_WB = kept.X_WB[stone.block];
  spec.elapsed = kept.elapsed;
  return spec;
}

/// What follows a visit.
enum class Next {
  kNothing,
  kAgain,   ///< the simulated hands finished without a visitor: the same with new ruins
  kOnward,  ///< the next task
};

/// Photographed models for the blocks; false: errors, which were told.
bool useModels(temple::Building& building, const Arguments& a) {
  if (a.models.empty()) return true;
  Diagnostics diagnostics;
  std::vector<std::string> lines;
  {
    const terminal::Waiting waiting("simplifying the models of " + a.models);
    lines = temple::useModels(building, a.models, diagnostics);
  }
  std::fputs(diagnostics.text().c_str(), stderr);
  for (const std::string& line : lines) std::printf("%s\n", line.c_str());
  return !diagnostics.hasErrors();
}

/// One visit. `seconds`: added to the simulated time.
int runOnce(Arguments& a, Next& next, double& seconds) {
  Diagnostics diagnostics;
  std::optional<temple::KeptSession> kept;
  const std::string kept_file =
      !a.kept.empty() ? a.kept : temple::sessionFile(a.visits.empty() ? temple::defaultVisitFolder() : a.visits);
  if (a.go_on) {
    kept = temple::readKept(kept_file, diagnostics);
    if (kept) {
      std::tie(a.size, a.plan) = temple::sizeAndPlan(kept->size);
      std::tie(a.parameters, a.seed, a.tenon) = std::tie(kept->parameters, kept->seed, kept->tenon);
    }
  }
  const std::string building_name = temple::buildingName(a.size, a.plan);
  temple::Proportions proportions = a.parameters.empty() ? temple::shippedProportions(building_name, diagnostics)
                                                         : temple::readProportions(a.parameters, diagnostics);
  if (a.tenon && !diagnostics.hasErrors())
    temple::addTenons(proportions, a.parameters.empty() ? building_name : a.parameters, diagnostics);
  AssemblyWords words = temple::shippedWords(a.language, diagnostics);
  if (a.tenon) temple::tellOfTenons(words, a.language);
  checkOutputs(a, diagnostics);
  std::optional<temple::Building> building;
  std::optional<temple::SceneSpec> spec;
  if (!diagnostics.hasErrors()) {
    building = temple::makeBuilding(proportions, kBehind, a.seed);
    if (kept) spec = specOf(*building, *kept, kept_file, diagnostics);
  }
  std::fputs(diagnostics.text().c_str(), stderr);
  if (diagnostics.hasErrors() || !useModels(*building, a)) return kExitBadInput;

  if (!spec)
    spec = a.assembled ? temple::assembled(*building)
                       : ruinsOf(*building, a.seed, a.parameters.empty() && !a.tenon ? building_name : "");
  if (!spec) return kExitInterrupted;
  if (!a.assembled || a.visit()) {
    spec->to_be_built = true;
    spec->words = words;
  }
  spec->painted = a.painted;
  if (!a.rig.empty()) spec->rig = std::filesystem::absolute(a.rig).lexically_normal().string();
  if (!a.folder.empty()) {
    const std::string scene = temple::writeScene(*building, *spec, a.folder);
    std::printf("%s: %zu blocks, %.0f mm high when built\n", scene.c_str(), building->blocks.size(),
                1e3 * building->top);
  }
  if (a.visit()) {
    if (!kept) {
      kept = temple::KeptSession{building_name, a.parameters, a.seed, 0, 0, {}, a.tenon};
      for (const temple::SceneSpec::Stone& stone : spec->stones) kept->X_WB.push_back(stone.X_WB);
    }
    const temple::VisitEnd end = runVisit(*building, std::move(*spec), a, proportions, std::move(*kept));
    next = end.again ? Next::kAgain : end.onward ? Next::kOnward : Next::kNothing;
    seconds += end.rebuilt.simulated_seconds;
    return end.again ? kExitOk : reportRebuild(end.rebuilt, a);
  }
  return a.screenshot.empty() ? kExitOk : takePicture(*building, *spec, a);
}

int showCounts(const Arguments& a) {
  Diagnostics diagnostics;
  const std::string table = temple::countsTable(a.counts.empty() ? temple::defaultCountsFile() : a.counts, diagnostics);
  std::fputs(diagnostics.text().c_str(), stderr);
  std::fputs(table.c_str(), stdout);
  return diagnostics.hasErrors() ? kExitBadInput : kExitOk;
}

int runTemple(Arguments a) {
  const std::string first = a.size;
  const double limit = a.limit;
  for (double seconds = 0;;) {
    Next next = Next::kNothing;
    const int status = runOnce(a, next, seconds);
    if (limit > 0) a.limit = limit - seconds;
    if (next == Next::kNothing || (limit > 0 && a.limit <= 0)) return status;
    a.size = next == Next::kOnward ? nextTask(a) : first;
    ++a.seed;
    a.attracting = next == Next::kAgain;
    a.go_on = false;
    a.folder.clear();
  }
}

}  // namespace

void addTemple(Command app, int& status) {
  auto a = std::make_shared<Arguments>();
  Command command =
      app.command("temple", "A Doric temple in blocks that two fingers can hold: its ruins, or the building");
  command.flag("--auto", a->automatic,
               "two simulated fingers rebuild it from its ruins, by friction alone, against the clock");
  Option lockstep = command.flag("--lockstep", a->lockstep, "in virtual time, as fast as the machine goes");
  command.option("--time-scale", a->time_scale, "in virtual time: simulated seconds per wall-clock second")
      .positive()
      .excludes(lockstep);
  command.option("--for", a->limit, "end after this many simulated seconds (default with --auto: 100 a block)")
      .positive();
  command.option("--summary", a->summary, "JSON: what was placed, how exactly, in what time");
  command.option("--language", a->language, "language of the texts for visitors")
      .oneOf(temple::shippedLanguages())
      .showDefault();
  command.option("--session", a->visits,
                 "folder for log.jsonl (events, no personal data) and session.json (blocks in place), or none\n"
                 "(default against the clock: " +
                     temple::defaultVisitFolder() + ", else none)");
  command.option("--count", a->counts,
                 "file to which visits are added, one line for each that begins, is finished or left: day, task, "
                 "seconds; or none\n"
                 "(default against the clock: " +
                     temple::defaultCountsFile() + ", else none)");
  command.flag("--counts", a->show_counts, "show the visits counted in that file, by day and task, and end");
  command.flag("--one-task", a->one_task, "stay with this task: no larger one is offered when it is finished");
  Option attract =
      command
          .option(
              "--attract", a->attract,
              "after this many seconds without a touch, simulated hands continue until the next touch (default: never)")
          .positive();
  command.option("--continue", a->kept, "continue from a session.json, also after a crash (default: that of --session)")
      .values(0, 1);
  command
      .option("--size", a->size,
              "first: a short column of three pieces; column: six pieces; facade: a front of four columns, 45 pieces\n"
              "(default: first for a visitor with a mouse, else column)")
      .oneOf(temple::shippedNames());
  command
      .option(
          "--plan", a->plan,
          "measures after vitruvius (De architectura), or of the parthenon, which name their sources in config/temple\n"
          "(the first task has its own)")
      .oneOf(temple::shippedPlans())
      .showDefault();
  command.flag("--tenon", a->tenon,
               "each capital has a tenon of wood, which must be felt into the mortise of the drum below it");
  command.flag("--no-help", a->no_help,
               "do not help a visitor with a mouse to grasp (the help fades with every block placed; a device that is "
               "felt never gets any)");
  Option voice = command.flag("--voice", a->voice,
                              "read the sentences about the blocks aloud, in the language of the texts (espeak-ng)");
  command.flag("--assembled,--no-ruins", a->assembled,
               "every block where it belongs, instead of ruins strewn by a physics drop");
  Option sound = command.flag("--sound", a->sound,
                              "play stone on stone (aplay; without this option where a window and a sound device are)");
  command.option("--sound-file", a->sound_file, "WAV of what stone on stone sounds like in the visit; plays nothing");
  command
      .flag("--quiet", a->quiet,
            "for whoever looks after an exhibit: no sound, no voice, no simulated hands, no line in the terminal")
      .excludes(voice)
      .excludes(sound)
      .excludes(attract);
  command.flag("--painted", a->painted,
               "in the colours of which traces were found: triglyphs blue, metopes red, the pediment's wall blue");
  command
      .option("--models", a->models,
              "folder of photographed models, KIND.glb, .gltf, .obj or .ply (drum, capital, …: apps/temple/models):\n"
              "blocks of that kind are drawn and felt as the model, and move as before")
      .existingFolder();
  command.option("--seed", a->seed, "seed of the damage to the stones and of the places where the blocks fell")
      .showDefault();
  command.option("--write", a->folder, "folder for scene.xml and its meshes, which presa check, explain and run take");
  command.flag("--overwrite", a->overwrite, "let --write replace what the folder holds");
  command
      .option("--rig", a->rig,
              "rig of the visitor's thumb and index (default: mouse and keyboard in the window; a written scene "
              "has no fingers)")
      .existingFile();
  command.option("--screenshot", a->screenshot, "PNG of the scene at its start, with --auto at its end");
  command.option("--video", a->video, "MP4 of the visit through ffmpeg");
  addVideoRate(command, a->asked);
  addPictureOptions(command, a->asked, a->show);
  command.option("--screenshot-every", a->screenshots, "SECONDS DIR: a PNG every SECONDS simulated seconds")
      .values(2, 2);
  command
      .option("--view", a->view,
              "window, offscreen or none (default: window against the clock, where there is a display)")
      .oneOf({"window", "offscreen", "none"});
  addBusOptions(command, a->bus.bus, "publish the visit for presa view --join");
  addBusCommandsOption(command, a->bus.bus_commands);
  addGuideOption(command, a->bus);
  command.flag("--allow-no-rt", a->allow_no_rt,
               "let hardware run where the system refuses real-time scheduling: with half the force");
  command
      .option("--parameters", a->parameters,
              "proportions of another building, as in config/temple/facade.xml, each with its source")
      .excludes(command.named("--size"))
      .excludes(command.named("--plan"));
  command.footer(
      "Exit status: 0 done, 1 the picture could not be drawn or not every block was placed, 2 bad input or blocks that "
      "do not come to rest (nothing\n"
      "written), 130 Ctrl-C (likewise).\n"
      "Examples:\n"
      "  presa temple --language it\n"
      "  presa temple --auto --lockstep --seed 7 --screenshot column.png\n"
      "  presa temple --size facade --screenshot ruins.png\n"
      "  presa temple --size column --assembled --write out/column && presa run out/column/scene.xml --lockstep");
  command.action([a, command, &status] {
    if (a->show_counts) {
      status = showCounts(*a);
      return;
    }
    a->go_on = command.given("--continue");
    if (a->size.empty()) a->size = a->anybody() && a->parameters.empty() ? "first" : "column";
    status = runTemple(*a);
  });
}

}  // namespace presa
