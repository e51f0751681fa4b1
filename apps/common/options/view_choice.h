#pragma once
#include <string>

#include "framework/scene/world.h"

namespace presa {

/// Where a picture goes: as the user says (window, offscreen, none), else (empty) to a window when somebody looks on while it goes
/// (`live`) and there is a display, else off-screen when a file is `drawn`, else nowhere.
RunOptions::View chooseView(const std::string& wanted, bool live, bool drawn);

}  // namespace presa
