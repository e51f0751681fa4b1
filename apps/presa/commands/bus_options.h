#pragma once
#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "framework/scene/scene.h"

namespace presa {

/// Adds --bus NETWORK and --domain N; `bus` stays empty where the user says neither.
void addBusOptions(CLI::App& command, std::optional<BusSettings>& bus, const std::string& what_for);

/// Adds --bus-commands.
void addBusCommandsOption(CLI::App& command, bool& open);

}  // namespace presa
