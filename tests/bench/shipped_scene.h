#pragma once
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "framework/session/load_world.h"

namespace presa::bench {

/// A file of config/scenes, ready to run.
inline Loaded loadShipped(const std::string& scene, std::vector<std::string> sets = {},
                          const RunOptions& options = {}) {
  Diagnostics diagnostics;
  Loaded loaded =
      loadWorld({std::string(PRESA_SOURCE_DIR) + "/config/scenes/" + scene, "", std::move(sets)}, options, diagnostics);
  if (diagnostics.hasErrors()) throw std::runtime_error(diagnostics.text());
  return loaded;
}

}  // namespace presa::bench
