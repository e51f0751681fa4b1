#pragma once
#include "framework/bus/bus_keys.h"
#include "modules/bus_dds/participant.h"

namespace presa::bus_dds {

/// Settings of a participant with DDS Security 1.1, using the plug-ins of Cyclone DDS: it presents its certificate,
/// accepts only participants with a certificate of the same authority, and encrypts all traffic. Throws InputError E756
/// when the plug-ins are not installed.
Qos securityQos(const bus::KeyFiles& keys);

}  // namespace presa::bus_dds
