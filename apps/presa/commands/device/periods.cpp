#include "apps/presa/device/periods.h"

#include <memory>

#include "apps/presa/commands/device/device_commands.h"

namespace presa {

void addPeriods(CLI::App& app, int& status) {
  auto options = std::make_shared<device::PeriodsOptions>();
  CLI::App* command =
      app.add_subcommand("periods", "How much one scene's load stretches the haptic period, against another's");
  command->add_option("FIRST", options->scenes[0], "scene")->required()->check(CLI::ExistingFile);
  command->add_option("SECOND", options->scenes[1], "scene that is compared with it")
      ->required()
      ->check(CLI::ExistingFile);
  command->add_option("--runs", options->runs, "of each, in turn")->check(CLI::Range(1, 100000))->capture_default_str();
  command->add_option("--for", options->seconds, "seconds of each run")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--seed", options->seed, "of the bootstrap")->capture_default_str();
  command->add_option("--out", options->out, "folder for periods.json");
  command->footer(
      "Leave the machine to it: it is its hitches that this measures. Exit status: 0 compared, 2 bad input, 130 "
      "Ctrl-C.\n"
      "Example:  presa device periods experiments/faults/hold.xml experiments/faults/stack.xml --runs 100");
  command->callback([options, &status] { status = device::comparePeriods(*options); });
}

}  // namespace presa
