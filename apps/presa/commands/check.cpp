#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/presa/commands/commands.h"
#include "framework/scene/decompositions.h"
#include "framework/session/load_world.h"

namespace presa {
namespace {

struct CheckArguments {
  std::vector<std::string> scenes;
  std::string rig, format = "text";
  std::vector<std::string> sets;
};

nlohmann::json toJson(const Diagnostic& diagnostic) {
  return {{"severity", diagnostic.severity == Diagnostic::Severity::kError ? "error" : "warning"},
          {"code", diagnostic.code},
          {"file", diagnostic.where.file},
          {"line", diagnostic.where.line},
          {"column", diagnostic.where.column},
          {"message", diagnostic.message},
          {"help", diagnostic.help}};
}

nlohmann::json toJson(const DecomposedMesh& mesh) {
  return {{"body", mesh.body}, {"file", mesh.file}, {"pieces", mesh.pieces}, {"hausdorff_mm", 1e3 * mesh.error}};
}

int check(const CheckArguments& arguments) {
  bool good = true;
  nlohmann::json report = nlohmann::json::array();
  for (const std::string& scene : arguments.scenes) {
    Diagnostics diagnostics;
    RunOptions options;
    options.bound_stiffness = true;
    const Loaded loaded = loadWorld({scene, arguments.rig, arguments.sets}, options, diagnostics);
    good = good && !diagnostics.hasErrors();
    if (arguments.format == "json") {
      nlohmann::json findings = nlohmann::json::array();
      for (const Diagnostic& diagnostic : diagnostics.all()) findings.push_back(toJson(diagnostic));
      nlohmann::json decomposed = nlohmann::json::array();
      if (loaded.world) {
        for (const DecomposedMesh& mesh : decompositionsOf(*loaded.world)) decomposed.push_back(toJson(mesh));
      }
      report.push_back(
          {{"scene", scene}, {"valid", !diagnostics.hasErrors()}, {"findings", findings}, {"decomposed", decomposed}});
      continue;
    }
    std::fputs(diagnostics.text().c_str(), stderr);
    if (diagnostics.hasErrors()) {
      std::printf("%s: %zu error%s\n", scene.c_str(), diagnostics.errorCount(),
                  diagnostics.errorCount() == 1 ? "" : "s");
      continue;
    }
    std::size_t triangles = 0;
    for (const BodyMeshes& meshes : loaded.world->meshes)
      triangles += meshes.haptic ? meshes.haptic->triangles.size() : 0;
    const std::size_t joints = loaded.world->scene.joints.size();
    const std::string jointed =
        joints == 0 ? "" : ' ' + std::to_string(joints) + (joints == 1 ? " joint," : " joints,");
    std::printf("%s: good (%zu bodies,%s %zu materials, %zu devices, %zu haptic triangles)\n", scene.c_str(),
                loaded.world->scene.bodies.size(), jointed.c_str(), loaded.world->scene.materials.size(),
                loaded.world->scene.devices.size(), triangles);
    for (const DecomposedMesh& mesh : decompositionsOf(*loaded.world)) std::printf("  %s\n", textOf(mesh).c_str());
  }
  if (arguments.format == "json") std::printf("%s\n", report.dump(2).c_str());
  return good ? kExitOk : kExitBadInput;
}

}  // namespace

void addCheck(Command app, int& status) {
  auto arguments = std::make_shared<CheckArguments>();
  Command command = app.command("check", "Read scenes with their rigs and meshes, and report everything that is wrong");
  command.option("SCENE", arguments->scenes, "scene files").required();
  command.option("--rig", arguments->rig, "rig file instead of the scene's own");
  command.option("--set", arguments->sets, "PATH=VALUE, e.g. body/cube/physics/mass=0.1; may be repeated");
  command.option("--format", arguments->format, "text or json").oneOf({"text", "json"});
  command.footer("Exit status: 0 every scene is good, 2 otherwise.\nExample:  presa check config/scenes/*.xml");
  command.action([arguments, &status] { status = check(*arguments); });
}

}  // namespace presa
