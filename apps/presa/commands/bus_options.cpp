#include "apps/presa/commands/bus_options.h"

namespace presa {

void addBusOptions(CLI::App& command, std::optional<BusSettings>& bus, const std::string& what_for) {
  const auto settings = [&bus]() -> BusSettings& {
    if (!bus) bus.emplace();
    return *bus;
  };
  command
      .add_option_function<std::string>(
          "--bus", [settings](const std::string& network) { settings().network = network; },
          what_for + ": loopback (this machine), lan or lan:INTERFACE (others, too), none")
      ->check(CLI::Validator(
          [](const std::string& network) {
            return isBusNetwork(network) ? std::string{}
                                         : "a network is loopback, lan, lan:INTERFACE or none, found '" + network + "'";
          },
          "NETWORK"));
  command
      .add_option_function<int>(
          "--domain", [settings](const int& domain) { settings().domain = domain; },
          "number of the bus, where several are in use (default 0)")
      ->check(CLI::Range(kLeastBusDomain, kMostBusDomain));
}

void addBusCommandsOption(CLI::App& command, bool& open) {
  command.add_flag("--bus-commands", open,
                   "let others on the bus set parameters of the run (presa bus set); without it nobody is listened to");
}

}  // namespace presa
