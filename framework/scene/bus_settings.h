#pragma once
#include "framework/scene/scene.h"

namespace presa {

/// The network of others, or commands: what is for the command line to open, and for a rig that it names; never for a scene.
bool opensMoreThanASceneMay(const BusSettings& bus);

}  // namespace presa
