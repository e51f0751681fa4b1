#include <cstdio>
#include <filesystem>
#include <map>
#include <set>

#include "apps/presa/commands/commands.h"
#include "framework/plugin/plugin_loader.h"
#include "framework/scene/manifest.h"

namespace presa {
namespace {

namespace fs = std::filesystem;

std::string boundsOf(const Manifest::Attribute& attribute) {
  if (attribute.above.empty() && attribute.min.empty() && attribute.max.empty()) return {};
  const std::string low = !attribute.above.empty() ? "(" + attribute.above
                          : !attribute.min.empty() ? "[" + attribute.min
                                                   : "(-inf";
  return " in " + low + ", " + (attribute.max.empty() ? "inf)" : attribute.max + "]");
}

void print(const Manifest::Attribute& attribute) {
  const std::string unit = attribute.unit.empty() ? "" : " [" + attribute.unit + "]";
  const std::string given = attribute.required ? "required" : "default " + attribute.default_value;
  std::printf("      %-12s %s%s%s, %s: %s\n", attribute.name.c_str(), attribute.type.c_str(), unit.c_str(),
              boundsOf(attribute).c_str(), given.c_str(), attribute.about.c_str());
}

void printSetting(const Manifest::Attribute& setting) {
  const std::string unit = setting.unit.empty() ? "" : " [" + setting.unit + "]";
  const std::string given = setting.required ? "" : ", default " + setting.default_value;
  std::printf("      %-12s %s%s%s: %s\n", setting.name.c_str(), setting.type.c_str(), unit.c_str(), given.c_str(),
              setting.about.c_str());
}

/// When a run needs a module: "dynamics rate, engine 'ode', when free_body".
std::string roleOf(const Manifest::ModuleRole& role) {
  std::string text = std::string(toString(role.rate)) + " rate";
  if (!role.engine.empty()) text += ", engine '" + role.engine + "'";
  for (std::size_t i = 0; i < role.wanted.size(); ++i) {
    text += i == 0 ? ", when" : ", or";
    for (const std::string& fact : role.wanted[i]) text += " " + fact;
  }
  return text;
}

/// A plug-in of this name in a later folder is not used: a stale copy in PRESA_PLUGIN_PATH must not go unnoticed.
void printHidden(const Manifest& manifest) {
  const fs::path own(manifest.file);
  for (const std::string& folder : pluginFolders()) {
    const fs::path other = fs::path(folder) / own.filename();
    std::error_code ignored;
    if (fs::exists(other, ignored) && !fs::equivalent(other, own, ignored))
      std::printf("  hides %s\n", other.lexically_normal().c_str());
  }
}

void print(const Manifest& manifest) {
  std::printf("%s %s (%s), %s\n  %s\n", manifest.name.c_str(), manifest.version.c_str(), nameOf(manifest.kind),
              fs::path(manifest.file).parent_path().lexically_normal().c_str(), manifest.about.c_str());
  printHidden(manifest);
  if (manifest.kind == PluginKind::kModule) std::printf("    %s\n", roleOf(manifest.module).c_str());
  for (const Manifest::Attribute& setting : manifest.settings) printSetting(setting);
  for (const Manifest::Element& element : manifest.elements) {
    std::printf("    <%s> in <%s>\n", element.name.c_str(), nameOf(element.place));
    for (const Manifest::Attribute& attribute : element.attributes) print(attribute);
  }
}

/// Libraries that have no manifest, by their folder; the first folder that has a name counts.
std::map<fs::path, std::set<std::string>> otherLibraries(const std::vector<Manifest>& all) {
  std::set<std::string> known;
  for (const Manifest& manifest : all) known.insert("presa_" + manifest.name + ".so");
  std::map<fs::path, std::set<std::string>> others;
  for (const std::string& folder : pluginFolders()) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
      const std::string file = entry.path().filename().string();
      if (!file.starts_with("presa_") || entry.path().extension() != ".so" || !known.insert(file).second) continue;
      others[fs::path(folder).lexically_normal()].insert(file.substr(6, file.size() - 9));
    }
  }
  return others;
}

int listPlugins() {
  const std::vector<Manifest>& all = manifests();
  for (const Manifest& manifest : all) print(manifest);
  for (const auto& [folder, names] : otherLibraries(all)) {
    std::printf("Without a manifest, %s\n ", folder.c_str());
    for (const std::string& name : names) std::printf(" %s", name.c_str());
    std::printf("\n");
  }
  return kExitOk;
}

}  // namespace

void addPlugins(Command app, int& status) {
  Command command =
      app.command("plugins", "List the plug-ins, the elements that they bring to scenes, and the settings of drivers");
  command.footer(
      "Plug-ins are looked for in the folders of --allow-plugins and of PRESA_PLUGIN_PATH (separated by colons), then\n"
      "beside Presa's own.\n"
      "No library is loaded for this list. A scene loads only the plug-ins that it names.");
  command.action([&status] { status = listPlugins(); });
}

}  // namespace presa
