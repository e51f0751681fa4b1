#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace presa {

/// Adds --show PART,no-PART…: what the picture shows besides its own choice, or leaves out.
void addShowOption(CLI::App& command, std::vector<std::string>& show);

}  // namespace presa
