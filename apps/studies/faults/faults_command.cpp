#include "apps/studies/faults/runner.h"

#include <memory>

#include "apps/studies/faults/fault_commands.h"

namespace presa {

void addFaults(Command app, int& status) {
  auto options = std::make_shared<faults::RunnerOptions>();
  Command command =
      app.command("faults", "What happens under a hand when samples, threads or devices fail, at many random moments");
  command.option("--runs", options->runs, "of each fault").withinCount(1, 1000000).showDefault();
  command.option("--seed", options->seed, "of the moments").showDefault();
  command.option("--only", options->only, "faults with this in their name");
  command.option("--out", options->out, "folder for faults.html and faults.json");
  command.option("--jobs", options->jobs, "processes at once (default: one per processor)").positive();
  command.footer(
      "Exit status: 0 every run kept every bound, 1 some did not, 2 bad input.\n"
      "Example:  presa device faults --runs 100 --out out/faults");
  command.action([options, &status] { status = faults::runFaults(*options); });
}

}  // namespace presa
