#pragma once
#include <memory>

#include "framework/bus/guide_link.h"
#include "framework/bus/state_bus.h"
#include "framework/bus/wall_link.h"

namespace presa::bus_dds {

/// Throw InputError: E720 the network cannot be used, E721 this process uses the domain on another network or with
/// other keys.
std::unique_ptr<bus::Writer> makeWriter(const BusSettings& settings);
std::unique_ptr<bus::Reader> makeReader(const BusSettings& settings);
std::unique_ptr<bus::CommandPost> makePost(const BusSettings& settings);
std::unique_ptr<bus::Commander> makeCommander(const BusSettings& settings);
std::unique_ptr<bus::WallLink> makeWallLink(const BusSettings& settings);
std::unique_ptr<bus::OrderPost> makeOrderPost(const BusSettings& settings);
std::unique_ptr<bus::OrderSender> makeOrderSender(const BusSettings& settings);

}  // namespace presa::bus_dds
