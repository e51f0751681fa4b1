#include "framework/scene/bus_settings.h"

#include <algorithm>

#include "framework/scene/run_options.h"
#include "framework/scene/scene_parts.h"

namespace presa {

bool isBusNetwork(const std::string& network) {
  constexpr std::size_t kLongestInterface = 15;  // IFNAMSIZ without the terminating zero
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

void settleBus(const Scene& scene, const Rig& rig, RunOptions& options) {
  options.bus = busOf(scene, rig, options);
  options.bus_commands = options.bus_commands || (options.bus && options.bus->commands);
}

void checkSceneBus(const xml::Element& root, Diagnostics& diagnostics) {
  const std::string help = "on the command line, or in a rig that the command line names";
  for (const xml::Element& bus : root.children("bus")) {
    const std::string network = bus.attribute("network");
    if (!bus.flawed("network") && network.starts_with("lan"))
      diagnostics.error(
          751, bus.where("network"),
          "a scene must not open the network, found " + quote(network) + "; loopback and none are allowed",
          "--bus " + network + " " + help);
    if (!bus.flawed("commands") && bus.boolean("commands", false))
      diagnostics.error(751, bus.where("commands"), "a scene must not let others set parameters of its run",
                        "--bus-commands " + help + ": commands=\"true\"");
  }
}

bool opensMoreThanASceneMay(const BusSettings& bus) { return bus.commands || bus.network.starts_with("lan"); }

std::optional<BusSettings> readBus(const xml::Element& root) {
  std::optional<BusSettings> bus;
  for (const xml::Element& element : root.children("bus"))
    bus = {element.attribute("network"), static_cast<int>(element.number("domain", 0)),
           element.boolean("commands", false),
           element.hasAttribute("keys") ? element.attribute("keys") : std::string()};
  return bus;
}

}  // namespace presa
