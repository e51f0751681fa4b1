#include "apps/common/options/bus_options.h"

#include <filesystem>

#include "framework/bus/bus_keys.h"

namespace presa {

void addBusOptions(Command command, std::optional<BusSettings>& bus, const std::string& what_for) {
  const auto settings = [&bus]() -> BusSettings& {
    if (!bus) bus.emplace();
    return *bus;
  };
  command
      .each(
          "--bus", [settings](const std::string& network) { settings().network = network; },
          what_for + ": loopback (this machine), lan or lan:INTERFACE (others, too), none")
      .checked(
          [](const std::string& network) {
            return isBusNetwork(network) ? std::string{}
                                         : "a network is loopback, lan, lan:INTERFACE or none, found '" + network + "'";
          },
          "NETWORK");
  command
      .eachNumber(
          "--domain", [settings](const int& domain) { settings().domain = domain; },
          "number of the bus, where several are in use (default 0)")
      .withinCount(kMinBusDomain, kMaxBusDomain);
  command.each(
      "--bus-keys", [settings](const std::string& folder) { settings().keys = folder; },
      "folder of this process's certificate, one of DIR/run, DIR/viewer, DIR/commander and DIR/guide that presa bus "
      "keys makes");
}

void addMeshesOption(Command command, std::vector<std::string>& folders) {
  std::error_code unknown;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", unknown);
  const auto shipped = program.parent_path().parent_path().parent_path() / "config" / "meshes";
  if (std::filesystem::is_directory(shipped, unknown)) folders.push_back(shipped.string());
  command
      .each(
          "--meshes", [&folders](const std::string& folder) { folders.push_back(folder); },
          "a folder with meshes that the run's scene may need, found there by their SHA-256 (besides Presa's\n"
          "config/meshes); a path that the bus names is never opened; may be repeated")
      .existingFolder()
      .atOnce();
}

void addBusCommandsOption(Command command, bool& open) {
  command.flag("--bus-commands", open,
               "let others on the bus set parameters of the run (presa bus set); without it, commands are ignored");
}

void addGuideOption(Command command, RunOptions& options) {
  command
      .each(
          "--guide",
          [&options](const std::string& where) {
            options.guide = where == "viewer" ? RunOptions::Guide::kViewer : RunOptions::Guide::kBeside;
          },
          "where the guide of the assembly runs: beside the dynamics (default), or in a viewer, which sends its "
          "decisions\n"
          "over the bus (presa view --join --guide; needs --bus-commands)")
      .oneOf({"beside", "viewer"});
}

void checkBusCommands(bool asked, const RunOptions& loaded, Diagnostics& diagnostics) {
  if (diagnostics.hasErrors()) return;
  if (asked && !loaded.bus)
    diagnostics.error(122, {"--bus-commands", 0, 0}, "--bus-commands needs a bus", "add --bus loopback, or --bus lan");
  else if (loaded.bus_commands && loaded.bus)
    bus::requireKeysForCommands(*loaded.bus);
}

}  // namespace presa
