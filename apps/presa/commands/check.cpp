#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/common/findings_json.h"
#include "apps/common/printed_figures.h"
#include "apps/common/terminal/text.h"
#include "apps/common/terminal/waiting.h"
#include "apps/presa/check/ask_experiment.h"
#include "apps/presa/check/file_checks.h"
#include "apps/presa/check/start_warnings.h"
#include "apps/presa/commands/commands.h"
#include "framework/scene/decompositions.h"
#include "framework/scene/scene_parts.h"
#include "framework/session/load_world.h"

namespace presa {
namespace {

struct CheckArguments {
  std::vector<std::string> files;
  std::string rig, format = "text";
  std::vector<std::string> sets;
  bool print_resolved = false, print_upgraded = false;
};

/// What was found about one file.
struct Checked {
  nlohmann::json report;
  std::string good;                  ///< about a file without errors
  std::vector<std::string> details;  ///< further lines about it
  std::string resolved;              ///< a scene without errors as it is read
};

constexpr double kMeasured = 0.1;  // simulated seconds in which the dynamics of meshes are measured

nlohmann::json toJson(const DecomposedMesh& mesh) {
  return {{"body", mesh.body}, {"file", mesh.file}, {"pieces", mesh.pieces}, {"hausdorff_mm", 1e3 * mesh.error}};
}

void printText(const Diagnostics& diagnostics, const CheckArguments& arguments) {
  if (arguments.format == "text") std::fputs(diagnostics.text().c_str(), stderr);
}

std::string sizesOf(const World& world) {
  std::size_t triangles = 0;
  for (const BodyMeshes& meshes : world.meshes) triangles += meshes.haptic ? meshes.haptic->triangles.size() : 0;
  const auto count = [](std::size_t n, const char* one, const char* several) {
    return std::to_string(n) + ' ' + (n == 1 ? one : several);
  };
  const Scene& scene = world.scene;
  std::string text = count(scene.bodies.size(), "body", "bodies");
  if (!scene.joints.empty()) text += ", " + count(scene.joints.size(), "joint", "joints");
  return text + ", " + count(scene.materials.size(), "material", "materials") + ", " +
         count(scene.devices.size(), "device", "devices") + ", " +
         count(triangles, "haptic triangle", "haptic triangles");
}

Checked checkScene(const std::string& file, const CheckArguments& arguments) {
  const terminal::Waiting waiting("checking " + file);
  Diagnostics diagnostics;
  RunOptions options;
  options.bound_stiffness = true;
  Loaded loaded = loadWorld({file, arguments.rig, arguments.sets}, options, diagnostics);
  printedOf(file, diagnostics);
  Checked checked;
  const std::shared_ptr<const World> world = loaded.world;
  if (!diagnostics.hasErrors()) {
    check::warnOfStart(loaded, diagnostics);
    check::warnOfSlowMeshes(std::move(loaded), kMeasured, diagnostics);
    checked.good = sizesOf(*world);
    checked.resolved = world->scene.resolved_xml;
  }
  checked.report = findingsJson(file, "scene", diagnostics);
  nlohmann::json& decomposed = checked.report["decomposed"] = nlohmann::json::array();
  if (world != nullptr) {
    for (const DecomposedMesh& mesh : decompositionsOf(*world)) {
      decomposed.push_back(toJson(mesh));
      checked.details.push_back(textOf(mesh));
    }
  }
  if (arguments.print_resolved) checked.report["resolved"] = checked.resolved;
  printText(diagnostics, arguments);
  return checked;
}

Checked checkAlone(const std::string& file, const std::string& kind,
                   std::string (*check)(const std::string&, Diagnostics&), const CheckArguments& arguments) {
  Diagnostics diagnostics;
  Checked checked;
  checked.good = kind + ", " + check(file, diagnostics);
  checked.report = findingsJson(file, kind, diagnostics);
  printText(diagnostics, arguments);
  return checked;
}

Checked checkOne(const std::string& file, const CheckArguments& arguments) {
  switch (check::kindOf(file)) {
    case check::FileKind::kRig:
      return checkAlone(file, "rig", check::checkRig, arguments);
    case check::FileKind::kMotion:
      return checkAlone(file, "motion", check::checkMotion, arguments);
    case check::FileKind::kWalls:
      return checkAlone(file, "walls", check::checkWalls, arguments);
    case check::FileKind::kExperiment: {  // its reader belongs to another program
      Checked checked;
      checked.report = check::askExperiment(file, arguments.rig, arguments.format);
      checked.good = "experiment";
      return checked;
    }
    case check::FileKind::kScene:
      break;
  }
  return checkScene(file, arguments);
}

void printResult(const std::string& file, const Checked& checked) {
  std::size_t errors = 0;
  for (const nlohmann::json& finding : checked.report.at("findings"))
    errors += finding.at("severity") == "error" ? 1 : 0;
  const bool valid = checked.report.at("valid").get<bool>();
  if (valid) std::printf("%s: good (%s)\n", file.c_str(), checked.good.c_str());
  if (!valid) std::printf("%s: %zu error%s\n", file.c_str(), errors, errors == 1 ? "" : "s");
  for (const std::string& detail : checked.details) {
    if (valid) std::printf("  %s\n", detail.c_str());
  }
}

int checkAll(const CheckArguments& arguments) {
  bool good = true;
  nlohmann::json report = nlohmann::json::array();
  for (const std::string& file : arguments.files) {
    const Checked checked = checkOne(file, arguments);
    good = good && checked.report.at("valid").get<bool>();
    if (arguments.format == "text" && arguments.print_resolved) std::fputs(checked.resolved.c_str(), stdout);
    if (arguments.format == "text" && !arguments.print_resolved) printResult(file, checked);
    report.push_back(checked.report);
  }
  if (arguments.format == "json") std::printf("%s\n", report.dump(2).c_str());
  return good ? kExitOk : kExitBadInput;
}

/// Scenes in the format of this release, with their comments; nothing else about them is checked.
int printUpgraded(const CheckArguments& arguments) {
  Diagnostics diagnostics;
  for (const std::string& file : arguments.files) {
    const auto document = xml::Document::load(file, diagnostics);
    if (document == nullptr) continue;
    if (document->root().name() != "scene") {
      diagnostics.error(123, document->root().where(),
                        "--print-upgraded is for scenes, found <" + document->root().name() + ">",
                        "rigs, motions and experiments have had one format so far");
      continue;
    }
    upgrade(document->root());
    std::fputs(document->text().c_str(), stdout);
  }
  std::fputs(diagnostics.text().c_str(), stderr);
  return diagnostics.hasErrors() ? kExitBadInput : kExitOk;
}

}  // namespace

void addCheck(Command app, int& status) {
  auto arguments = std::make_shared<CheckArguments>();
  Command command = app.command(
      "check",
      "Read scenes with their rigs and meshes, rigs, motions, experiments and walls of a CAVE; tell all that is wrong");
  command.option("FILE", arguments->files, "files of scenes, rigs, motions, experiments or walls").required();
  command.option("--rig", arguments->rig, "rig file instead of the one that a scene or an experiment names");
  command.option("--set", arguments->sets, "PATH=VALUE, e.g. body/cube/physics/mass=0.1; may be repeated");
  command.flag("--print-resolved", arguments->print_resolved,
               "print scenes as they are read: what they include in its place, all defaults, absolute paths; nothing "
               "of other files");
  command.flag("--print-upgraded", arguments->print_upgraded,
               "print scenes of an older format in that of this release, and check nothing");
  command.option("--format", arguments->format, "text or json").oneOf({"text", "json"});
  command.footer(
      "A rig and a motion are checked without a scene.\nExit status: 0 every file is good, 2 otherwise.\n"
      "Example:  presa check config/scenes/*.xml config/rigs/*.xml config/motions/*");
  command.action(
      [arguments, &status] { status = arguments->print_upgraded ? printUpgraded(*arguments) : checkAll(*arguments); });
}

}  // namespace presa
