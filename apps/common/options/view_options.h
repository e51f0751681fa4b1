#pragma once
#include <string>
#include <vector>

#include "apps/common/options/command_line.h"
#include "framework/scene/run_options.h"

namespace presa {

/// Chooses where a picture goes: the user's choice (window, offscreen, none); if that is empty, a window if the run is
/// watched `live` and there is a display, else off-screen if a file is `drawn`, else none.
RunOptions::View chooseView(const std::string& wanted, bool live, bool drawn);

/// Adds --show PART,no-PART…: parts that the picture shows in addition to its defaults, or leaves out.
void addShowOption(Command command, std::vector<std::string>& show);

}  // namespace presa
