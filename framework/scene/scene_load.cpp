#include <algorithm>
#include <filesystem>

#include "framework/scene/joints/joint_parts.h"
#include "framework/scene/manifest.h"
#include "framework/scene/physics_shapes.h"
#include "framework/scene/scene_copy.h"
#include "framework/scene/scene_parts.h"

namespace presa {
namespace {

enum SceneFileCode { kVersion = 201 };

/// How to get the plug-in that brings an unknown element. Plug-ins beside a scene are found, but a library that came
/// with a scene runs only if the user says so.
std::string ifUnknown(const std::string& element, const std::string& file) {
  const std::filesystem::path scene = std::filesystem::path(file).parent_path();
  for (const char* folder : {"plugins", "../build/lib/presa"}) {
    const std::string near = (scene / folder).lexically_normal().string();
    Diagnostics of_others;
    for (const Manifest& manifest : readManifests({near}, of_others)) {
      if (std::ranges::find(manifest.elements, element, &Manifest::Element::name) == manifest.elements.end()) continue;
      return "; plug-in '" + manifest.name + "' in " + near + " brings it: --allow-plugins " + near +
             ", or name that folder in PRESA_PLUGIN_PATH";
    }
  }
  return "; if a plug-in brings it, install the plug-in, or name its folder with --allow-plugins or in "
         "PRESA_PLUGIN_PATH (presa plugins)";
}

const xml::Schema& sceneSchema() {
  static const xml::Schema schema(sceneSchemaWith(manifests()), ifUnknown);
  return schema;
}

Scene loadDocument(xml::Document& document, bool from_file, const std::string& directory,
                   const std::vector<Override>& overrides, Diagnostics& diagnostics) {
  const std::size_t errors_before = diagnostics.errorCount();
  bool whole = true;  // else references to what is missing would only be further findings
  Scene scene;
  scene.file = document.name();
  if (document.root().name() == sceneSchema().root().name) {
    upgrade(document.root());
    applyDefaults(document.root(), sceneSchema().root(), diagnostics);
    expandIncludes(document, sceneSchema().root(), from_file, diagnostics);
    whole = diagnostics.errorCount() == errors_before;
    applyOverrides(document.root(), sceneSchema().root(), overrides, diagnostics);
  }
  document.validate(sceneSchema(), diagnostics);
  if (document.root().name() != sceneSchema().root().name) return scene;
  checkVersion(document.root(), "scene", kVersion, diagnostics);
  removeIncludes(document.root());
  if (!whole) return scene;
  resolveFrictionPresets(document.root(), diagnostics);
  checkScene(document.root(), diagnostics);
  checkSceneBus(document.root(), diagnostics);
  if (diagnostics.errorCount() > errors_before) return scene;  // all or nothing
  const bool coupling_stated = statesCoupling(document.root());
  resolveScene(document, sceneSchema(), directory);
  scene = readScene(document.root(), document.name(), directory);
  if (!coupling_stated) chooseCoupling(scene, document.root());
  checkJointLoops(scene, diagnostics);
  scene.resolved_xml = document.text();
  return scene;
}

}  // namespace

void checkVersion(const xml::Element& root, const std::string& kind, int code, Diagnostics& diagnostics) {
  if (!root.hasAttribute("version") || root.flawed("version")) return;
  const std::string version = root.attribute("version");
  const int major = std::stoi(version);
  const int minor = std::stoi(version.substr(version.find('.') + 1));
  const std::string ours = std::to_string(kFormatMajor) + "." + std::to_string(kFormatMinor);
  if (major != kFormatMajor) {
    diagnostics.error(code, root.where("version"),
                      "this " + kind + " is written in format " + quote(version) + "; this release of Presa reads " +
                          std::to_string(kFormatMajor) + ".x",
                      major > kFormatMajor ? "use a newer release of Presa" : "write version=\"" + ours + "\"");
  } else if (minor > kFormatMinor) {
    diagnostics.warning(code, root.where("version"),
                        "this " + kind + " is written in format " + quote(version) + ", newer than " + ours,
                        "names that are new in that format are reported as unknown");
  }
}

std::string resolvePath(const std::string& path, const std::string& directory) {
  if (path.empty()) return path;
  return std::filesystem::absolute(std::filesystem::path(directory) / path).lexically_normal().string();
}

std::vector<xml::Element> materialElements(const xml::Element& root) {
  std::vector<xml::Element> materials;
  for (const xml::Element& list : root.children("materials")) {
    for (const xml::Element& material : list.children("material")) materials.push_back(material);
  }
  return materials;
}

std::vector<xml::Element> deviceElements(const xml::Element& root) {
  std::vector<xml::Element> devices;
  for (const xml::Element& list : root.children("devices")) {
    for (const xml::Element& device : list.children("device")) devices.push_back(device);
  }
  return devices;
}

Scene loadScene(const std::string& file, const std::vector<Override>& overrides, Diagnostics& diagnostics) {
  const auto document = xml::Document::load(file, diagnostics);
  Scene nothing;
  nothing.file = file;
  if (!document) return nothing;
  return loadDocument(*document, true, std::filesystem::path(file).parent_path().string(), overrides, diagnostics);
}

Scene parseScene(const std::string& xml, const std::string& name, const std::string& directory,
                 const std::vector<Override>& overrides, Diagnostics& diagnostics) {
  const auto document = xml::Document::parse(xml, name, diagnostics);
  Scene nothing;
  nothing.file = name;
  if (!document) return nothing;
  return loadDocument(*document, false, directory, overrides, diagnostics);
}

Scene readCopy(const std::string& text, const std::string& to, Diagnostics& diagnostics) {
  const auto document = xml::Document::parse(text, to, diagnostics);
  if (!document) return {};
  return loadDocument(*document, true, std::filesystem::absolute(to).parent_path().string(), {}, diagnostics);
}

std::vector<std::string> filesNamedBy(const Scene& scene) {
  std::vector<std::string> files;
  for (const MeshRef* mesh : meshesOf(scene)) files.push_back(mesh->file);
  for (const PluginElement& element : scene.plugin_elements) {
    const std::vector<std::string> named = filesNamedBy(element);
    files.insert(files.end(), named.begin(), named.end());
  }
  return files;
}

}  // namespace presa
