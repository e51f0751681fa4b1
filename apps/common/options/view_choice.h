#pragma once
#include <string>

#include "framework/scene/run_options.h"

namespace presa {

/// Chooses where a picture goes: the user's choice (window, offscreen, none); if that is empty, a window if the run is
/// watched `live` and there is a display, else off-screen if a file is `drawn`, else none.
RunOptions::View chooseView(const std::string& wanted, bool live, bool drawn);

}  // namespace presa
