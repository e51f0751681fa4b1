#include "framework/bus/state_bus.h"

#include "framework/bus/guide_link.h"
#include "framework/bus/wall_link.h"
#include "framework/plugin/plugin_loader.h"
#include "framework/scene/manifest.h"

namespace presa::bus {
namespace {

void* symbolOf(const char* name) { return pluginSymbol(manifestGiving("bus").name, name); }

}  // namespace

// The plug-in returns owning raw pointers; ownership is taken here.
std::unique_ptr<Writer> openWriter(const BusSettings& settings) {
  using Open = Writer* (*)(const BusSettings&);
  return std::unique_ptr<Writer>(reinterpret_cast<Open>(symbolOf("presaOpenBusWriter"))(settings));
}

std::unique_ptr<Reader> openReader(const BusSettings& settings) {
  using Open = Reader* (*)(const BusSettings&);
  return std::unique_ptr<Reader>(reinterpret_cast<Open>(symbolOf("presaOpenBusReader"))(settings));
}

std::unique_ptr<CommandPost> openPost(const BusSettings& settings) {
  using Open = CommandPost* (*)(const BusSettings&);
  return std::unique_ptr<CommandPost>(reinterpret_cast<Open>(symbolOf("presaOpenBusPost"))(settings));
}

std::unique_ptr<Commander> openCommander(const BusSettings& settings) {
  using Open = Commander* (*)(const BusSettings&);
  return std::unique_ptr<Commander>(reinterpret_cast<Open>(symbolOf("presaOpenBusCommander"))(settings));
}

std::unique_ptr<WallLink> openWallLink(const BusSettings& settings) {
  using Open = WallLink* (*)(const BusSettings&);
  return std::unique_ptr<WallLink>(reinterpret_cast<Open>(symbolOf("presaOpenBusWalls"))(settings));
}

std::unique_ptr<OrderPost> openOrderPost(const BusSettings& settings) {
  using Open = OrderPost* (*)(const BusSettings&);
  return std::unique_ptr<OrderPost>(reinterpret_cast<Open>(symbolOf("presaOpenBusOrderPost"))(settings));
}

std::unique_ptr<OrderSender> openOrderSender(const BusSettings& settings) {
  using Open = OrderSender* (*)(const BusSettings&);
  return std::unique_ptr<OrderSender>(reinterpret_cast<Open>(symbolOf("presaOpenBusOrderSender"))(settings));
}

}  // namespace presa::bus
