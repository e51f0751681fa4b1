#pragma once
#include <string>

#include "framework/session/load_world.h"

namespace presa::cost {

/// The rig as an XML text in which no finger's damping depends on the rates any more: what the scene as it stands asks
/// for is written down, so that every setting has the same hands. Empty without devices.
std::string rigWithFixedDamping(const Loaded& base);

}  // namespace presa::cost
