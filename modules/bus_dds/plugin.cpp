#include "framework/session/module_plugin.h"

#include <dds/version.h>

#include "framework/bus/publisher.h"
#include "modules/bus_dds/dds_bus.h"

namespace presa::bus_dds {
namespace {

std::unique_ptr<Module> create(std::shared_ptr<const World> world, const RunOptions& options) {
  const BusSettings settings = options.bus.value_or(BusSettings{});
  return std::make_unique<bus::Publisher>(
      std::move(world), options, [settings] { return makeWriter(settings); }, [settings] { return makePost(settings); },
      [settings] { return makeOrderPost(settings); });
}

std::string library() { return "Cyclone DDS " DDS_VERSION; }

const ModulePlugin kPlugin{.name = "bus_dds", .create = &create, .library = &library};

}  // namespace
}  // namespace presa::bus_dds

PRESA_MODULE_PLUGIN(presa::bus_dds::kPlugin)

extern "C" __attribute__((visibility("default"))) presa::bus::Writer* presaOpenBusWriter(
    const presa::BusSettings& settings) {
  return presa::bus_dds::makeWriter(settings).release();
}

extern "C" __attribute__((visibility("default"))) presa::bus::Reader* presaOpenBusReader(
    const presa::BusSettings& settings) {
  return presa::bus_dds::makeReader(settings).release();
}

extern "C" __attribute__((visibility("default"))) presa::bus::Commander* presaOpenBusCommander(
    const presa::BusSettings& settings) {
  return presa::bus_dds::makeCommander(settings).release();
}

extern "C" __attribute__((visibility("default"))) presa::bus::WallLink* presaOpenBusWalls(
    const presa::BusSettings& settings) {
  return presa::bus_dds::makeWallLink(settings).release();
}

extern "C" __attribute__((visibility("default"))) presa::bus::CommandPost* presaOpenBusPost(
    const presa::BusSettings& settings) {
  return presa::bus_dds::makePost(settings).release();
}

extern "C" __attribute__((visibility("default"))) presa::bus::OrderPost* presaOpenBusOrderPost(
    const presa::BusSettings& settings) {
  return presa::bus_dds::makeOrderPost(settings).release();
}

extern "C" __attribute__((visibility("default"))) presa::bus::OrderSender* presaOpenBusOrderSender(
    const presa::BusSettings& settings) {
  return presa::bus_dds::makeOrderSender(settings).release();
}
