#pragma once
#include "framework/bus/bus_keys.h"
#include "modules/bus_dds/participant.h"

namespace presa::bus_dds {

/// What a participant is created with, so that it shows its certificate, takes nothing from who has none of the same authority, and
/// everything it sends is encrypted: DDS Security 1.1, by the plug-ins that come with Cyclone DDS. Throws InputError E756 where those are
/// not installed.
Qos securityQos(const bus::KeyFiles& keys);

}  // namespace presa::bus_dds
