#pragma once
#include <cstddef>
#include <memory>

#include "experiments/runner/psychophysics/axis.h"
#include "experiments/runner/psychophysics/method.h"
#include "framework/core/math/random.h"
#include "framework/plugin/plugin_loader.h"
#include "framework/scene/plugin_element.h"

/// A psychophysical method as a plug-in: its manifest (kind="method") brings one element that stands in `<procedure>`;
/// its class derives from Method, whose contract holds: the next level is a function of the element, the stream and the
/// log. Everything here is inline, so that a method links the framework alone.
namespace presa::psychophysics {

/// Table of a method plug-in. Thread: main.
struct MethodPlugin {
  int abi = kPluginAbi;  ///< leave it as it is: another version is refused (E510)
  const char* name;      ///< as in the manifest
  /// A method at its first trial. `axis` converts values that the element gives into levels; `stream` is the stream
  /// "method" of the block's seed, the only source of random numbers. May throw (E596, with the element's place).
  std::unique_ptr<Method> (*create)(const PluginElement& element, const Axis& axis, const RandomStream& stream);
  /// The max number of answers until the method has finished, > 0; one more breaks the contract (E617).
  std::size_t (*max_trials)(const PluginElement& element);
};

}  // namespace presa::psychophysics

/// Exports `table`, a MethodPlugin that lives as long as the library. Once in a plug-in, outside of namespaces.
#define PRESA_METHOD_PLUGIN(table)                                                                                  \
  extern "C" __attribute__((visibility("default"))) const presa::psychophysics::MethodPlugin* presaMethodPlugin() { \
    return &(table);                                                                                                \
  }
