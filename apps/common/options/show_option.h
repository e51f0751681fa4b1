#pragma once
#include <string>
#include <vector>
#include "apps/common/options/command_line.h"

namespace presa {

/// Adds --show PART,no-PART…: parts that the picture shows in addition to its defaults, or leaves out.
void addShowOption(Command command, std::vector<std::string>& show);

}  // namespace presa
