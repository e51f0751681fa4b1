#include <memory>

#include "apps/common/exit_status.h"
#include "apps/common/options/command_line.h"
#include "apps/studies/stability/runner.h"

namespace presa {

void addStability(Command app, int& status) {
  auto options = std::make_shared<stability::RunnerOptions>();
  Command command = app.command(
      "stability",
      "Run the hard cases with Presa's methods and the methods that they replace, and report which are stable");
  command.option("--case", options->cases, "only this case; may be repeated (--list names them)");
  command.flag("--list", options->list, "name the cases and what each is held against");
  command.flag("--quick", options->quick, "the subset that the tests run");
  command.option("--out", options->out, "folder for report.html and rows.jsonl");
  command.option("--format", options->format, "text or json (one line per row)").oneOf({"text", "json"});
  command.option("--jobs", options->jobs, "trials at a time; 0: as many as there are processors").nonNegative();
  command.footer(
      "Exit status: 0 no verdict is worse than expected, 1 some are, 2 bad input, 130 Ctrl-C.\n"
      "Example:  presa stability --out out/stability\n"
      "          presa stability --case grasp_in_air --format json | jq .verdict");
  command.action([options, &status] { status = stability::runCases(*options); });
}

}  // namespace presa
