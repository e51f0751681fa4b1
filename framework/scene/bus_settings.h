#pragma once
#include "framework/scene/scene.h"

namespace presa {

/// True for a network beyond this machine, or for commands: only the command line and a rig named on it may enable
/// those.
bool opensMoreThanASceneMay(const BusSettings& bus);

}  // namespace presa
