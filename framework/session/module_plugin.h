#pragma once
#include <memory>
#include <string>

#include "framework/core/graph/module.h"
#include "framework/plugin/plugin_loader.h"
#include "framework/scene/run_options.h"
#include "framework/scene/world.h"

/// A plug-in is a shared object `presa_<folder>.so` built from one folder under modules/ or devices/. It exports one
/// C function that returns its table; it is loaded only when the plan calls for it.
namespace presa {

/// Table of a module plug-in.
struct ModulePlugin {
  int abi = kPluginAbi;  ///< leave it as it is: another version is refused (E510)
  const char* name;      ///< of its manifest, which says when a run needs it
  /// One module, of the rate that the manifest says; null or another rate: E596.
  std::unique_ptr<Module> (*create)(std::shared_ptr<const World> world, const RunOptions& options);
  std::string (*library)() = nullptr;  ///< outside library and version: "ODE 0.16.2"; null: none
};

}  // namespace presa

/// Exports `table`, a ModulePlugin that lives as long as the library. Once in a plug-in, outside of namespaces.
#define PRESA_MODULE_PLUGIN(table) \
  extern "C" __attribute__((visibility("default"))) const presa::ModulePlugin* presaModulePlugin() { return &(table); }
