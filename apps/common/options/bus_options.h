#pragma once
#include <optional>
#include <string>
#include <vector>
#include "apps/common/options/command_line.h"

#include "framework/scene/run_options.h"

namespace presa {

/// Adds --bus NETWORK, --domain N and --bus-keys DIR; `bus` stays empty if the user gives none of them.
void addBusOptions(Command command, std::optional<BusSettings>& bus, const std::string& what_for);

/// Adds --meshes DIR; the folder of Presa's own meshes comes before those that the user names.
void addMeshesOption(Command command, std::vector<std::string>& folders);

/// Adds --bus-commands.
void addBusCommandsOption(Command command, bool& open);
/// Adds --guide beside|viewer.
void addGuideOption(Command command, RunOptions& options);
/// E122 --bus-commands without a bus; E752 commands without keys on a network that others are on. `loaded`: what holds
/// for the run.
void checkBusCommands(bool asked, const RunOptions& loaded, Diagnostics& diagnostics);

}  // namespace presa
