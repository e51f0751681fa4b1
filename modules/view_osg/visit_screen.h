#pragma once
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "framework/scene/world.h"

namespace presa::view {

/// True for a scene that is shown to visitors of any age: its words say what to do with mouse and keys. Their screen
/// has no name of a scene, no time, no figure and no word of the trade.
inline bool forVisitors(const World& world) {
  return world.scene.assembly && !world.scene.assembly->words.actions.empty();
}

/// True when the visitor has a mouse, rather than a device that is felt.
inline bool withMouse(const World& world) {
  return std::ranges::any_of(world.rig.devices, [](const DeviceBinding& device) { return device.driver == "pointer"; });
}

/// The help table in the visitors' language: keys, and what they do. Empty: not for visitors.
inline std::vector<std::pair<std::string, std::string>> visitorHelp(const World& world) {
  std::vector<std::pair<std::string, std::string>> lines;
  if (!forVisitors(world)) return lines;
  for (const AssemblyWords::Action& action : world.scene.assembly->words.actions)
    lines.emplace_back(action.keys, action.does);
  return lines;
}

}  // namespace presa::view
