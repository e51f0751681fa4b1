#include <algorithm>

#include "framework/scene/scene_parts.h"
#include "framework/scene/world.h"

namespace presa {

bool isBusNetwork(const std::string& network) {
  constexpr std::size_t kLongestInterface = 15;  // IFNAMSIZ without its end
  if (network == "loopback" || network == "lan" || network == "none") return true;
  if (!network.starts_with("lan:")) return false;
  const std::string interface = network.substr(4);
  const auto allowed = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '.' || c == '-'; };
  return !interface.empty() && interface.size() <= kLongestInterface && std::ranges::all_of(interface, allowed);
}

std::optional<BusSettings> busOf(const Scene& scene, const Rig& rig, const RunOptions& options) {
  const std::optional<BusSettings>& bus = options.bus ? options.bus : rig.bus ? rig.bus : scene.bus;
  return bus && bus->network != "none" ? bus : std::nullopt;
}

bool takesCommands(const World& world) {
  const std::optional<BusSettings> bus = busOf(world);
  return world.options.bus_commands || (bus && bus->commands);
}

std::optional<BusSettings> readBus(const xml::Element& root) {
  std::optional<BusSettings> bus;
  for (const xml::Element& element : root.children("bus"))
    bus = {element.attribute("network"), static_cast<int>(element.number("domain", 0)),
           element.boolean("commands", false)};
  return bus;
}

}  // namespace presa
