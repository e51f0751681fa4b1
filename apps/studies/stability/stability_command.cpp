#include <memory>

#include "apps/common/exit_status.h"
#include "apps/common/options/command_line.h"
#include "apps/studies/stability/runner.h"
#include "framework/core/diagnostics/refuse.h"

namespace presa {
namespace {

void addCaseOptions(Command command, stability::RunnerOptions& options) {
  command.option("--case", options.cases, "only this case; may be repeated (--list names them)");
  command.flag("--quick", options.quick, "the subset that the tests run");
}

void addReportOptions(Command command, stability::RunnerOptions& options) {
  command.option("--out", options.out, "folder for report.html and rows.jsonl");
  command.option("--format", options.format, "text or json (one line per row)").oneOf({"text", "json"});
}

void addMerge(Command stability, const std::shared_ptr<bool>& chosen, int& status) {
  struct Arguments {
    std::vector<std::string> folders;
    stability::RunnerOptions options;
  };
  auto a = std::make_shared<Arguments>();
  Command command =
      stability.command("merge", "Bring the shards of a run together: the same report as of the whole run");
  command.option("FOLDER", a->folders, "folders that presa stability --shard I/N wrote, one for each I").required();
  addReportOptions(command, a->options);
  command.footer(
      "Exit status: 0 no verdict is worse than expected, 1 some are, 2 bad input.\n"
      "Example:  for i in 1 2; do presa stability --shard $i/2 --out part_$i; done; presa stability merge part_*");
  command.action([a, chosen, &status] {
    *chosen = true;
    status = stability::mergeCases(a->folders, a->options);
  });
}

void addSubmit(Command stability, const std::shared_ptr<bool>& chosen, int& status) {
  struct Arguments {
    stability::RunnerOptions options;
    cluster::SubmitOptions cluster;
  };
  auto a = std::make_shared<Arguments>();
  Command command =
      stability.command("submit", "Run the cases on a Slurm cluster: shards as a job array, then the merge");
  addCaseOptions(command, a->options);
  addReportOptions(command, a->options);
  command.named("--out").required();
  cluster::addSubmitOptions(command, a->cluster);
  command.footer(
      "Exit status: 0 no verdict is worse than expected, 1 some are, or a shard never finished, 2 bad input or no "
      "cluster,\n"
      "130 Ctrl-C (the array is cancelled; --resume goes on).\n"
      "The folder of --out must be seen by all nodes.\n"
      "Example:  presa stability submit --slurm --tasks 16 --out /scratch/stability");
  command.action([a, chosen, &status] {
    *chosen = true;
    status = stability::submitCases(a->options, a->cluster);
  });
}

}  // namespace

void addStability(Command app, int& status) {
  auto options = std::make_shared<stability::RunnerOptions>();
  Command command = app.command(
      "stability",
      "Run the hard cases with Presa's methods and the methods that they replace, and report which are stable");
  addCaseOptions(command, *options);
  command.flag("--list", options->list, "name the cases and what each is held against");
  addReportOptions(command, *options);
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
  auto other = std::make_shared<bool>(false);  // another command follows
  addMerge(command, other, status);
  addSubmit(command, other, status);
  command.action([options, other, &status] {
    if (*other) return;
    if (options->shard && options->out.empty()) refuse(123, "--shard", "needs a folder of its own", "--out FOLDER");
    status = stability::runCases(*options);
  });
}

}  // namespace presa
