#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>

#include "apps/common/replace_all.h"
#include "apps/presa/commands/commands.h"
#include "apps/presa/templates/templates.h"
#include "framework/core/diagnostics/refuse.h"
#include "framework/plugin/plugin_loader.h"
#include "framework/scene/manifest.h"

namespace presa {
namespace {

namespace fs = std::filesystem;

enum Code { kBadName = 597, kCannotWrite = 598 };

constexpr const char* kToolRenderer = "tool_renderer";

struct NewArguments {
  std::string kind, name, folder = ".";
};

/// Text that a new file gets: path below the project's folder, contents.
struct NewFile {
  std::string path, text;
};

/// Replaces the one place where `from` stands.
void replaceIn(std::string& text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("a template for new projects has no '" + from + "'");
  text.replace(at, from.size(), to);
}

/// "soft_magnet" as the name of a class: "SoftMagnet".
std::string className(const std::string& name) {
  std::string out;
  bool upper = true;
  for (const char c : name) {
    if (c != '_') out += upper ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    upper = c == '_';
  }
  return out;
}

std::string shipped(const std::string& path) {
  for (const templates::File& file : templates::files()) {
    if (file.path == path) return file.text;
  }
  throw std::logic_error("no embedded file " + path);
}

/// The shipped cube with the rig of the project, and the plug-in's element where those of its kind stand.
std::string liftingScene(const NewArguments& arguments) {
  std::string scene = shipped("config/scenes/cube.xml");
  replaceIn(scene, R"(name="cube" rig="../rigs/pinch_cube.xml")", R"(name="lift" rig="rig.xml")");
  const std::string cube = R"(<body name="cube" material="rubber" pos="0 0 0.035">)";
  if (arguments.kind == "effect" || arguments.kind == "body")
    replaceIn(scene, cube, cube + "\n    <" + arguments.name + " max_force=\"0.5\"/>");
  if (arguments.kind == "module" || arguments.kind == "view") {
    const std::string body = arguments.kind == "module" ? " body=\"cube\"" : "";
    replaceIn(scene, "  <materials>", "  <" + arguments.name + body + "/>\n  <materials>");
  }
  if (arguments.kind == "surface") replaceIn(scene, cube, cube + "\n    <" + arguments.name + "/>");
  if (arguments.kind == "renderer")
    replaceIn(scene, "  <materials>", "  <haptics renderer=\"" + arguments.name + "\"/>\n  <materials>");
  if (arguments.kind == "friction") {
    replaceIn(scene, R"(<friction static="0.8" dynamic="0.6"/>)",
              R"(<friction static="0.8" dynamic="0.6"><)" + arguments.name + "/></friction>");
  }
  return scene;
}

/// The shipped fingers that pick up the cube.
std::vector<NewFile> scriptedFingers() {
  std::string rig = shipped("config/rigs/pinch_cube.xml");
  replaceAll(rig, "../motions/pinch_cube.xml", "motion.xml");
  return {{"scene/rig.xml", rig}, {"scene/motion.xml", shipped("config/motions/pinch_cube.xml")}};
}

/// The shipped comparison of two stiffnesses, with the project's method.
std::vector<NewFile> stiffnessExperiment(const NewArguments& arguments) {
  const std::string from = "experiments/stiffness_2afc/";
  std::string experiment = shipped(from + "experiment.xml");
  replaceIn(experiment, R"(name="stiffness_2afc")", "name=\"" + arguments.name + "\"");
  replaceIn(experiment, R"(<constant_stimuli values="600 740 870 1000 1150 1350 1660" per_level="36" per_block="4"/>)",
            "<" + arguments.name + "/>");
  replaceIn(experiment, "Seven constant stimuli about 1000 N/m.", "The method is this project's own.");
  std::vector<NewFile> files{{"scene/experiment.xml", experiment}};
  for (const char* name : {"scene.xml", "rig_scripted.xml", "press.csv"})
    files.push_back({std::string("scene/") + name, shipped(from + name)});
  return files;
}

/// The templates of that folder, with the project's name in the place of "KIND" in file names and of @name@ in texts.
std::vector<NewFile> fromTemplates(const std::string& folder, const NewArguments& arguments) {
  const std::string start = "apps/presa/templates/" + folder + "/";
  std::vector<NewFile> files;
  for (const templates::File& file : templates::files()) {
    std::string path = file.path, text = file.text;
    if (!path.starts_with(start)) continue;
    path = fs::path(path.substr(start.size())).replace_extension().string();  // without ".in"
    if (path.starts_with(arguments.kind)) path.replace(0, arguments.kind.size(), arguments.name);
    replaceAll(text, "@name@", arguments.name);
    replaceAll(text, "@Name@", className(arguments.name));
    files.push_back({path, text});
  }
  return files;
}

std::vector<NewFile> projectOf(const NewArguments& arguments) {
  std::vector<NewFile> files = fromTemplates("any", arguments);
  const auto add = [&](std::vector<NewFile> more) { std::ranges::move(more, std::back_inserter(files)); };
  add(fromTemplates(arguments.kind, arguments));
  if (arguments.kind == "experiment") {
    add(stiffnessExperiment(arguments));
  } else if (arguments.kind != kToolRenderer) {  // its template has a scene of its own
    files.push_back({"scene/lift.xml", liftingScene(arguments)});
    if (arguments.kind != "device") add(scriptedFingers());
  }
  std::ranges::sort(files, {}, &NewFile::path);
  return files;
}

void checkName(const std::string& name) {
  const bool good = !name.empty() && name.size() <= 40 && name.front() >= 'a' && name.front() <= 'z' &&
                    name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string::npos;
  if (!good) {
    refuse(kBadName, "", quote(name) + " cannot be the name of a plug-in",
           "up to 40 lower-case letters, digits and underscores, the first of them a letter");
  }
  for (const std::string& folder : pluginFolders()) {
    const fs::path taken = fs::path(folder) / ("presa_" + name + ".so");
    if (fs::exists(taken)) {
      refuse(kBadName, "", "there is a plug-in '" + name + "' already: " + taken.lexically_normal().string(),
             "choose another name; presa plugins lists those that are taken");
    }
  }
  // elements have the names of their plug-ins here, so Presa's own are taken, too
  if (sceneSchemaWith(manifests()).find("<xs:element name=\"" + name + "\"") != std::string::npos)
    refuse(kBadName, "", "<" + name + "> is an element of scenes already", "choose another name");
}

void write(const fs::path& project, const std::vector<NewFile>& files) {
  if (fs::exists(project)) {
    refuse(kCannotWrite, project.string(), "exists already, and nothing in it is overwritten",
           "choose another name, or another folder with --in FOLDER");
  }
  std::error_code error;
  fs::create_directories(project / "scene", error);
  for (const NewFile& file : files) {
    std::ofstream out(project / file.path);
    out << file.text;
    if (!out.flush()) refuse(kCannotWrite, (project / file.path).string(), "cannot be written");
  }
}

/// Where CMake looks for Presa: empty if it finds it by itself.
std::string prefixArgument() {
  std::error_code error;
  const fs::path prefix = fs::read_symlink("/proc/self/exe", error).parent_path().parent_path();
  if (!fs::exists(prefix / "lib/cmake/Presa", error)) return " -DCMAKE_PREFIX_PATH=PREFIX";
  return prefix == "/usr" || prefix == "/usr/local" ? "" : " -DCMAKE_PREFIX_PATH=" + prefix.string();
}

std::string nextSteps(const std::string& kind) {
  if (kind == "experiment")
    return "See its trials, and let simulated subjects do them:\n"
           "  export PRESA_PLUGIN_PATH=$PWD/build/lib/presa\n"
           "  presa experiment dry-run scene/experiment.xml\n"
           "  presa experiment run scene/experiment.xml --subject S01 --data data --lockstep\n";
  if (kind == "metric")
    return "See it over processor time:\n"
           "  export PRESA_PLUGIN_PATH=$PWD/build/lib/presa\n"
           "  presa cost scene/lift.xml --quick --metric ${PWD##*/}\n";
  const std::string scene = kind == kToolRenderer ? "scene/press.xml" : "scene/lift.xml";
  return "See it in the scene, and feel it:\n"
         "  export PRESA_PLUGIN_PATH=$PWD/build/lib/presa\n"
         "  presa explain " +
         scene + "\n  presa run " + scene + " --view window\n";
}

int writeNew(const NewArguments& arguments) {
  checkName(arguments.name);
  const fs::path project = (fs::path(arguments.folder) / arguments.name).lexically_normal();
  const std::vector<NewFile> files = projectOf(arguments);
  write(project, files);
  std::printf("%s:\n", project.c_str());
  for (const NewFile& file : files) std::printf("  %s\n", file.path.c_str());
  const std::string prefix = prefixArgument();
  std::printf(
      "\nBuild and test it:\n"
      "  cd %s\n"
      "  cmake -B build%s && cmake --build build && ctest --test-dir build\n"
      "%s",
      project.c_str(), prefix.c_str(), nextSteps(arguments.kind).c_str());
  if (prefix.ends_with("PREFIX"))
    std::printf("Presa is not installed: cmake --install build --prefix PREFIX, in its source tree, comes first.\n");
  return kExitOk;
}

}  // namespace

void addNew(Command app, int& status) {
  auto arguments = std::make_shared<NewArguments>();
  Command command = app.command("new", "Write a project outside the tree: a plug-in with a scene and a test");
  command
      .option(
          "KIND", arguments->kind,
          "effect: a force on the fingertips, with its reaction on a body; friction: a law of friction between fingers "
          "and bodies; body: a force on a body in the dynamics, such as drag; surface: a texture or a layer of a body; "
          "renderer: where surfaces hold the fingertips; tool_renderer: where bodies hold tools with volume; device: a "
          "driver that measures fingertips and renders forces; "
          "module: a part of the graph with a rate and ports; view: something drawn in the picture; "
          "metric: an error that presa cost draws over time; experiment: a comparison of two stiffnesses with a method "
          "of "
          "its own")
      .required()
      .oneOf({"effect", "body", "friction", "surface", "renderer", kToolRenderer, "device", "module", "view", "metric",
              "experiment"});
  command.option("NAME", arguments->name, "of the plug-in and its folder, e.g. soft_magnet").required();
  command.option("--in", arguments->folder, "folder in which the project's folder is made (default: this one)");
  command.footer(
      "The project builds against an installed Presa (find_package(Presa)), and its test lifts or presses a cube with\n"
      "the new plug-in. docs/plugins.md follows one from here to the first touch.\n"
      "Example:  presa new effect soft_magnet");
  command.action([arguments, &status] { status = writeNew(*arguments); });
}

}  // namespace presa
