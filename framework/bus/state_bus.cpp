#include "framework/bus/state_bus.h"

#include "framework/core/plugin/plugin_loader.h"

namespace presa::bus {

// The plug-in returns owning raw pointers; ownership is taken here.
std::unique_ptr<Writer> openWriter(const BusSettings& settings) {
  using Open = Writer* (*)(const BusSettings&);
  return std::unique_ptr<Writer>(reinterpret_cast<Open>(pluginSymbol("bus_dds", "presaOpenBusWriter"))(settings));
}

std::unique_ptr<Reader> openReader(const BusSettings& settings) {
  using Open = Reader* (*)(const BusSettings&);
  return std::unique_ptr<Reader>(reinterpret_cast<Open>(pluginSymbol("bus_dds", "presaOpenBusReader"))(settings));
}

std::unique_ptr<CommandPost> openPost(const BusSettings& settings) {
  using Open = CommandPost* (*)(const BusSettings&);
  return std::unique_ptr<CommandPost>(reinterpret_cast<Open>(pluginSymbol("bus_dds", "presaOpenBusPost"))(settings));
}

std::unique_ptr<Commander> openCommander(const BusSettings& settings) {
  using Open = Commander* (*)(const BusSettings&);
  return std::unique_ptr<Commander>(reinterpret_cast<Open>(pluginSymbol("bus_dds", "presaOpenBusCommander"))(settings));
}

}  // namespace presa::bus
