#include <memory>

#include "apps/common/options/commands.h"
#include "apps/studies/stability/runner.h"

namespace presa {

void addStability(CLI::App& app, int& status) {
  auto options = std::make_shared<stability::RunnerOptions>();
  CLI::App* command = app.add_subcommand(
      "stability", "Run the hard cases with Presa's methods and with what they replace, and say which hold");
  command->add_option("--case", options->cases, "only this case; may be repeated (--list names them)");
  command->add_flag("--list", options->list, "name the cases and what each is held against");
  command->add_flag("--quick", options->quick, "the subset that the tests run");
  command->add_option("--out", options->out, "folder for report.html and rows.jsonl");
  command->add_option("--format", options->format, "text or json (one line per row)")
      ->check(CLI::IsMember({"text", "json"}));
  command->add_option("--jobs", options->jobs, "trials at a time; 0: as many as there are processors")
      ->check(CLI::NonNegativeNumber);
  command->footer(
      "Exit status: 0 no verdict is worse than expected, 1 some are, 2 bad input, 130 Ctrl-C.\n"
      "Example:  presa stability --out out/stability\n"
      "          presa stability --case grasp_in_air --format json | jq .verdict");
  command->callback([options, &status] { status = stability::runCases(*options); });
}

}  // namespace presa
