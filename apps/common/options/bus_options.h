#pragma once
#include <optional>
#include <string>
#include <vector>
#include "apps/common/options/command_line.h"

#include "framework/scene/scene.h"

namespace presa {

/// Adds --bus NETWORK, --domain N and --bus-keys DIR; `bus` stays empty if the user gives none of them.
void addBusOptions(Command command, std::optional<BusSettings>& bus, const std::string& what_for);

/// Adds --meshes DIR; the folder of Presa's own meshes comes before those that the user names.
void addMeshesOption(Command command, std::vector<std::string>& folders);

/// Adds --bus-commands.
void addBusCommandsOption(Command command, bool& open);

}  // namespace presa
