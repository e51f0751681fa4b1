#include <memory>

#include "apps/common/exit_status.h"
#include "apps/common/options/command_line.h"
#include "apps/studies/stability/runner.h"
#include "framework/core/diagnostics/refuse.h"

namespace presa {
namespace {

void addMerge(Command stability, const std::shared_ptr<bool>& chosen, int& status) {
  struct Arguments {
    std::vector<std::string> folders;
    stability::RunnerOptions options;
  };
  auto a = std::make_shared<Arguments>();
  Command command =
      stability.command("merge", "Bring the shards of a run together: the same report as of the whole run");
  command.option("FOLDER", a->folders, "folders that presa stability --shard I/N wrote, one for each I").required();
  command.option("--out", a->options.out, "folder for report.html and rows.jsonl");
  command.option("--format", a->options.format, "text or json (one line per row)").oneOf({"text", "json"});
  command.footer(
      "Exit status: 0 no verdict is worse than expected, 1 some are, 2 bad input.\n"
      "Example:  for i in 1 2; do presa stability --shard $i/2 --out part_$i; done; presa stability merge part_*");
  command.action([a, chosen, &status] {
    *chosen = true;
    status = stability::mergeCases(a->folders, a->options);
  });
}

}  // namespace

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
  command
      .each(
          "--shard", [options](const std::string& text) { options->shard = cluster::shardFrom(text); },
          "run one of N parts of the trials, into the folder of --out; presa stability merge brings all N together")
      .checked(cluster::shardTrouble, "I/N");
  command.footer(
      "Exit status: 0 no verdict is worse than expected, 1 some are, 2 bad input, 130 Ctrl-C.\n"
      "Example:  presa stability --out out/stability\n"
      "          presa stability --case grasp_in_air --format json | jq .verdict");
  auto merges = std::make_shared<bool>(false);
  addMerge(command, merges, status);
  command.action([options, merges, &status] {
    if (*merges) return;
    if (options->shard && options->out.empty()) refuse(123, "--shard", "needs a folder of its own", "--out FOLDER");
    status = stability::runCases(*options);
  });
}

}  // namespace presa
