#include "framework/plugin/plugin_loader.h"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <mutex>
#include <sstream>

#include "framework/core/diagnostics/printable.h"
#include "framework/core/diagnostics/refuse.h"

extern "C" const char presa_framework_interface[];  // PresaInterface.cmake writes both sides

namespace presa {
namespace {

namespace fs = std::filesystem;

/// Folder of the shared object that contains this very function.
fs::path frameworkFolder() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<void*>(&pluginSymbol), &info) == 0 || info.dli_fname == nullptr) return {};
  return fs::path(info.dli_fname).parent_path();
}

/// Names come from rig and scene files; they must not lead out of the plug-in folders.
bool isPluginName(const std::string& name) {
  return !name.empty() && name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string::npos;
}

/// The headers that the shared object was built against, in words; empty: it does not say. Its code has not been called.
std::string interfaceOf(void* handle) {
  const auto* text = static_cast<const char*>(dlsym(handle, "presa_plugin_interface"));
  return text == nullptr ? "" : printable(text);
}

/// Of another hash, its idea of where a field or a virtual function lies may be wrong.
void requireInterface(void* handle, const std::string& path) {
  const std::string theirs = interfaceOf(handle);
  if (theirs == presa_framework_interface) return;
  refuse(510, path,
         "built for " + (theirs.empty() ? "a Presa that did not yet name its plug-in interface" : theirs) +
             ", this program is " + presa_framework_interface,
         "build it again: cmake --build BUILD in the plug-in's project, or ./dev build for Presa's own");
}

void* openPlugin(const std::string& name) {
  if (!isPluginName(name)) {
    refuse(590, "", "'" + name + "' is not the name of a plug-in",
           "a name consists of lower-case letters, digits and underscores");
  }
  const std::string file = "presa_" + name + ".so";
  std::string tried;
  for (const std::string& folder : pluginFolders()) {
    const fs::path path = fs::path(folder) / file;
    std::error_code ignored;
    if (!fs::exists(path, ignored)) {
      tried += (tried.empty() ? "" : ", ") + path.string();
      continue;
    }
    // RTLD_NOW: a plug-in that lacks a library fails here, not at its first call in a running haptic loop.
    if (void* handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL)) {
      requireInterface(handle, path.string());
      return handle;
    }
    const char* reason = dlerror();
    refuse(591, "", "plug-in " + path.string() + " does not load: " + (reason ? reason : "unknown reason"),
           "install the library it needs, or build it again with this version of Presa");
  }
  refuse(590, "", "there is no plug-in '" + name + "' (tried " + tried + ")",
         "build it, or name its folder with --allow-plugins or in the environment variable PRESA_PLUGIN_PATH");
}

}  // namespace

std::vector<std::string> pluginFolders() {
  std::vector<std::string> folders;
  if (const char* list = std::getenv("PRESA_PLUGIN_PATH")) {
    std::istringstream stream(list);
    for (std::string folder; std::getline(stream, folder, ':');)
      if (!folder.empty()) folders.push_back(folder);
  }
  folders.push_back(frameworkFolder());
  return folders;
}

void* pluginSymbol(const std::string& name, const char* symbol) {
  static std::mutex mutex;
  static std::map<std::string, void*> handles;
  const std::lock_guard lock(mutex);
  auto found = handles.find(name);
  if (found == handles.end()) found = handles.emplace(name, openPlugin(name)).first;
  if (void* address = dlsym(found->second, symbol)) return address;
  refuse(592, "", "plug-in '" + name + "' has no symbol '" + symbol + "'", "build it again with this version of Presa");
}

void requireAbi(const std::string& plugin, int abi) {
  if (abi == kPluginAbi) return;
  refuse(510, "presa_" + plugin + ".so",
         "built for plug-in interface " + std::to_string(abi) + ", this program has " + std::to_string(kPluginAbi),
         "build it again: cmake --build BUILD in the plug-in's project, or ./dev build for Presa's own");
}

std::string helperProgram(const std::string& name) { return frameworkFolder() / name; }

}  // namespace presa
