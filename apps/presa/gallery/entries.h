#pragma once
#include <optional>
#include <string>
#include <vector>

#include "framework/core/diagnostics/diagnostics.h"

namespace presa::gallery {

/// A scene of config/scenes.
struct Entry {
  std::string name;      ///< of its file, without .xml
  std::string group;     ///< what it teaches (groups.h); empty: it does not say
  std::string sentence;  ///< its description
  std::string file;      ///< path of the scene
  std::string picture;   ///< path of its stored picture; empty: there is none
};

/// All of them, by group in the order of groups(), then by name. Scenes are not checked here: a run does that. E141: the
/// program finds no config/scenes.
std::vector<Entry> entries(Diagnostics& diagnostics);

/// Index of the scene with that name. None with E140, which names the nearest.
std::optional<std::size_t> find(const std::vector<Entry>& entries, const std::string& name, Diagnostics& diagnostics);

}  // namespace presa::gallery
