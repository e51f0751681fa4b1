#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>

#include "apps/presa/atomic_file.h"
#include "apps/presa/commands/commands.h"
#include "apps/presa/run_session.h"
#include "apps/presa/scratch_folder.h"
#include "apps/presa/temple/rebuild.h"
#include "apps/presa/temple/ruins.h"
#include "apps/presa/temple/written_scene.h"
#include "apps/presa/terminal/job_progress.h"
#include "framework/temple/building.h"

namespace presa {
namespace {

constexpr double kBehind = 0.1;          // of the building's middle, from the field's [m]
constexpr double kEachBlock = 100;       // an automatic rebuilding is given up after so long a block [s]
constexpr double kPictureAfter = 0.005;  // one step of the dynamics [s]

struct Arguments {
  std::string size = "column", parameters, folder, rig, view, screenshot, summary;
  std::uint64_t seed = 1;
  double limit = 0;  // simulated [s]; 0: by the number of blocks
  bool assembled = false, overwrite = false, automatic = false;
  bool lockstep = true;  // there is no other way yet
};

void checkOutputs(const Arguments& a, Diagnostics& diagnostics) {
  if (a.folder.empty() && a.screenshot.empty() && !a.automatic)
    diagnostics.error(979, {"command line", 0, 0}, "there is nothing to do",
                      "--auto rebuilds it, --write DIR writes the scene, --screenshot FILE.png shows it");
  if (!a.folder.empty()) temple::checkTarget(a.folder, a.overwrite, diagnostics);
  if (a.view == "none" && !a.screenshot.empty())
    diagnostics.error(121, {"--screenshot", 0, 0}, "a screenshot needs a view, found --view none",
                      "use --view offscreen");
}

/// Every block where it fell; none when interrupted.
std::optional<temple::SceneSpec> ruinsOf(const temple::Building& building, std::uint64_t seed) {
  const ScratchFolder scratch;
  // the last job: all settle together
  terminal::JobProgress progress(building.blocks.size() + 1);
  std::size_t told = 0;
  const auto tell = [&](std::size_t lying, std::size_t, const std::string& what) {
    for (; told < lying; ++told) progress.done(what);
    progress.show();
    return !terminal::JobProgress::interrupted();
  };
  const temple::Ruins ruins = temple::strewRuins(building, seed, scratch.path().string(), tell);
  if (ruins.X_WB.empty()) return std::nullopt;
  temple::SceneSpec spec = temple::assembled(building);
  spec.name += "_ruins";
  spec.description = "What is left of a Doric building";
  spec.to_be_built = true;
  for (temple::SceneSpec::Stone& stone : spec.stones) stone.X_WB = ruins.X_WB[stone.block];
  return spec;
}

int takePicture(const temple::Building& building, temple::SceneSpec spec, const Arguments& a) {
  const ScratchFolder scratch;
  spec.rig.clear();
  RunOptions options;
  options.duration = kPictureAfter;
  options.view = RunOptions::View::kOffscreen;
  options.screenshot = a.screenshot;
  if (const auto folder = std::filesystem::path(a.screenshot).parent_path(); !folder.empty())
    std::filesystem::create_directories(folder);
  Diagnostics diagnostics;
  const Loaded loaded =
      loadWorld({temple::writeScene(building, spec, scratch.path().string()), "", {}}, options, diagnostics);
  std::fputs(diagnostics.text().c_str(), stderr);
  if (diagnostics.hasErrors()) return kExitBadInput;
  Run run(loaded, {.quiet = true, .command = "presa temple"});
  run.execute();
  for (const auto& fault : run.result().faults) std::fprintf(stderr, "%s\n", fault.text.c_str());
  if (!run.result().faults.empty()) return kExitFault;
  std::printf("%s\n", a.screenshot.c_str());
  return run.result().interrupted ? kExitInterrupted : kExitOk;
}

/// Two fingers of that pair, where the user names no other.
constexpr const char* kPair = R"(<rig version="1.0" name="assembling_pair">
  <device role="thumb" driver="assembling_hand"/><device role="index" driver="assembling_hand"/></rig>)";

int rebuildAlone(const temple::Building& building, temple::SceneSpec spec, const Arguments& a) {
  const ScratchFolder scratch;
  const std::filesystem::path rig = scratch.path() / "pair.xml";
  if (spec.rig.empty()) {
    writeFileAtomically(rig.string(), kPair);
    spec.rig = rig.string();
  }
  RunOptions options;
  options.duration = a.limit > 0 ? a.limit : kEachBlock * static_cast<double>(building.blocks.size());
  if (!a.screenshot.empty()) {
    options.view = RunOptions::View::kOffscreen;
    options.screenshot = a.screenshot;
  }
  Diagnostics diagnostics;
  const Loaded loaded =
      loadWorld({temple::writeScene(building, spec, scratch.path().string()), "", {}}, options, diagnostics);
  std::fputs(diagnostics.text().c_str(), stderr);
  if (diagnostics.hasErrors()) return kExitBadInput;

  terminal::JobProgress progress(building.blocks.size());
  int told = 0;
  const temple::Rebuilt rebuilt = temple::rebuild(loaded, options.duration, [&](int placed, int) {
    for (; told < placed; ++told) progress.done("rebuilding");
    progress.show();
    return !terminal::JobProgress::interrupted();
  });
  progress.finish();
  if (!a.summary.empty()) writeFileAtomically(a.summary, temple::summaryText(rebuilt, a.size, a.seed));
  std::printf(
      "%d of %d blocks in their places, at most %.3f mm and %.2f degrees off; %d dropped; %.0f s simulated in %.1f s\n",
      rebuilt.placed, rebuilt.pieces, 1e3 * rebuilt.worst_position_error,
      rebuilt.worst_angle_error * 180 / std::numbers::pi, rebuilt.drops, rebuilt.simulated_seconds,
      rebuilt.wall_seconds);
  if (terminal::JobProgress::interrupted()) return kExitInterrupted;
  return rebuilt.placed == rebuilt.pieces && rebuilt.faults == 0 ? kExitOk : kExitFault;
}

int runTemple(const Arguments& a) {
  Diagnostics diagnostics;
  const temple::Proportions proportions = a.parameters.empty() ? temple::shippedProportions(a.size, diagnostics)
                                                               : temple::readProportions(a.parameters, diagnostics);
  checkOutputs(a, diagnostics);
  std::fputs(diagnostics.text().c_str(), stderr);
  if (diagnostics.hasErrors()) return kExitBadInput;

  const temple::Building building = temple::makeBuilding(proportions, kBehind, a.seed);
  std::optional<temple::SceneSpec> spec = a.assembled ? temple::assembled(building) : ruinsOf(building, a.seed);
  if (!spec) return kExitInterrupted;
  if (!a.rig.empty()) spec->rig = std::filesystem::absolute(a.rig).lexically_normal().string();
  if (!a.folder.empty()) {
    const std::string scene = temple::writeScene(building, *spec, a.folder);
    std::printf("%s: %zu blocks, %.0f mm high when built\n", scene.c_str(), building.blocks.size(), 1e3 * building.top);
  }
  if (a.automatic) return rebuildAlone(building, *spec, a);
  return a.screenshot.empty() ? kExitOk : takePicture(building, *spec, a);
}

}  // namespace

void addTemple(CLI::App& app, int& status) {
  auto a = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("temple", "A Doric temple in blocks that two fingers can hold: its ruins, or the building");
  command->add_flag("--auto", a->automatic,
                    "two simulated fingers rebuild it from its ruins, by friction alone, as fast as the machine goes");
  command->add_flag("--lockstep", a->lockstep, "in virtual time, as --auto always runs");
  command->add_option("--for", a->limit, "give up after so many simulated seconds (default: 100 a block)")
      ->check(CLI::PositiveNumber);
  command->add_option("--summary", a->summary, "JSON: what --auto has placed, how exactly, in what time");
  command->add_option("--size", a->size, "column: six pieces; facade: a front of four columns, 45 pieces")
      ->check(CLI::IsMember(temple::shippedNames()))
      ->capture_default_str();
  command->add_flag("--assembled,--no-ruins", a->assembled,
                    "every block where it belongs, instead of ruins strewn by a physics drop");
  command->add_option("--seed", a->seed, "where stone broke off and blocks fell")->capture_default_str();
  command->add_option("--write", a->folder,
                      "folder for scene.xml and its meshes, which presa check, explain and run take");
  command->add_flag("--overwrite", a->overwrite, "let --write replace what the folder holds");
  command->add_option("--rig", a->rig, "rig whose thumb and index the scene gets (default: a scene without fingers)")
      ->check(CLI::ExistingFile);
  command->add_option("--screenshot", a->screenshot, "PNG of the scene at its start, with --auto at its end");
  command->add_option("--view", a->view, "offscreen (default with --screenshot) or none")
      ->check(CLI::IsMember({"offscreen", "none"}));
  command
      ->add_option("--parameters", a->parameters,
                   "proportions of another building, as in config/temple/facade.xml, each with its source")
      ->excludes("--size");
  command->footer(
      "Exit status: 0 done, 1 the picture could not be drawn or not every block was placed, 2 bad input or blocks that "
      "do not come to rest (nothing\n"
      "written), 130 Ctrl-C (likewise).\n"
      "Examples:\n"
      "  presa temple --auto --seed 7 --screenshot column.png\n"
      "  presa temple --size facade --screenshot ruins.png\n"
      "  presa temple --size column --assembled --write out/column && presa run out/column/scene.xml --lockstep");
  command->callback([a, &status] { status = runTemple(*a); });
}

}  // namespace presa
