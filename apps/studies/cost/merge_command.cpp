#include <cstdio>

#include "apps/common/exit_status.h"
#include "apps/studies/cost/apply.h"
#include "apps/studies/cost/driver.h"
#include "apps/studies/cost/shard.h"
#include "apps/studies/cost/shard_commands.h"
#include "apps/studies/cost/study_arguments.h"

namespace presa::cost {
namespace {

struct MergeArguments {
  MergeRequest request;
  int jobs = 0;
  std::string apply;
};

}  // namespace

int merge(const MergeRequest& request, int jobs, const std::string& apply) {
  Diagnostics diagnostics;
  Merged merged = mergeShards(request, diagnostics);
  if (!diagnostics.hasErrors() && !apply.empty()) checkApply(apply, merged.study, diagnostics);
  std::fputs(diagnostics.text().c_str(), stderr);
  if (diagnostics.hasErrors()) return kExitBadInput;
  Result result = runStudy(merged.study, {jobs, true, merged.instructions, merged.machine});
  result.command = commandLine({.request = merged.request, .apply = {}});  // the whole study has the same errors
  if (result.interrupted) return interrupted(merged.study.folder, "the same command");
  return writeResults(result, apply);
}

void addMerge(Command cost, const std::shared_ptr<bool>& chosen, int& status) {
  auto a = std::make_shared<MergeArguments>();
  Command command =
      cost.command("merge", "Bring the shards of a study together: the same report as of the whole study");
  command.option("FOLDER", a->request.folders, "folders that presa cost --shard I/N wrote, one for each I").required();
  command.option("--out", a->request.out,
                 "folder for report.html, front.svg, cost.csv, runs.csv and cost.json (default: cost_NAME)");
  command.flag("--mixed", a->request.mixed,
               "take shards of several machines: their errors; all costs are measured again, on this machine");
  command.option("--apply", a->apply, "as of presa cost");
  command.option("--jobs", a->jobs, "watched runs at a time (default: one per processor)").positive();
  command.footer(
      "Exit status: 0 done, 1 the reference could not be run, 2 bad input (nothing was written), 130 Ctrl-C.\n"
      "Errors are those of the whole study on one machine, to the bit. Runs of a finer reference are made here.\n"
      "Example:  for i in 1 2 3; do presa cost STUDY --shard $i/3 --out part_$i; done; presa cost merge part_*");
  command.action([a, chosen, &status] {
    *chosen = true;
    status = merge(a->request, a->jobs, a->apply);
  });
}

}  // namespace presa::cost
