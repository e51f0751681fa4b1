#pragma once
#include <string>

#include "framework/session/load_world.h"

namespace presa::cost {

/// The rig as XML text with the damping of every finger fixed at its value for the unmodified scene. Automatic damping
/// depends on the rates; fixed damping gives every setting the same hands. Empty without devices.
std::string rigWithFixedDamping(const Loaded& base);

}  // namespace presa::cost
