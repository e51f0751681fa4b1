#pragma once
#include <optional>
#include <string>

namespace presa {

/// A module that hosts plug-ins: of the haptic tick, or of the dynamics.
class PluginHost {
 public:
  virtual ~PluginHost() = default;
  /// The plug-in whose answer was no number or above its bound, "force effect <magnet> of body 'cube'", or none.
  /// Thread: any.
  virtual std::optional<std::string> brokenPlugin() const = 0;
};

}  // namespace presa
