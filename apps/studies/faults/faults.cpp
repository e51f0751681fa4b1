#include "apps/studies/faults/runner.h"

#include <memory>

#include "apps/presa/commands/device/device_commands.h"

namespace presa {

void addFaults(CLI::App& app, int& status) {
  auto options = std::make_shared<faults::RunnerOptions>();
  CLI::App* command = app.add_subcommand(
      "faults", "What happens under a hand when samples, threads or devices fail, at many random moments");
  command->add_option("--runs", options->runs, "of each fault")->check(CLI::Range(1, 1000000))->capture_default_str();
  command->add_option("--seed", options->seed, "of the moments")->capture_default_str();
  command->add_option("--only", options->only, "faults with this in their name");
  command->add_option("--out", options->out, "folder for faults.html and faults.json");
  command->add_option("--jobs", options->jobs, "processes at once (default: one per processor)")
      ->check(CLI::PositiveNumber);
  command->footer(
      "Exit status: 0 every run kept every bound, 1 some did not, 2 bad input.\n"
      "Example:  presa device faults --runs 100 --out out/faults");
  command->callback([options, &status] { status = faults::runFaults(*options); });
}

}  // namespace presa
