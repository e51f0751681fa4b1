#include "apps/temple/trials/trials_command.h"

#include <cstdio>
#include <memory>

#include "apps/common/exit_status.h"
#include "apps/temple/building/proportions.h"
#include "apps/temple/trials/results.h"
#include "framework/core/diagnostics/refuse.h"

namespace presa {
namespace {

using namespace temple;

void addPlanOptions(Command command, TrialsPlan& plan) {
  command.option("--size", plan.size, "first: three pieces; column: six pieces; facade: 45 pieces")
      .oneOf(shippedNames())
      .showDefault();
  command.option("--plan", plan.plan, "measures after vitruvius or of the parthenon")
      .oneOf(shippedPlans())
      .showDefault();
  command.option("--seeds", plan.seeds, "ruins, each of the next seed").withinCount(1, 100000).showDefault();
  command.option("--first-seed", plan.first_seed, "seed of the first ruins").showDefault();
  command.option("--for", plan.limit, "time for each [simulated s] (default: 100 a block)").positive();
}

int run(const TrialsPlan& plan) {
  if (plan.out.empty())
    refuse(123, "presa temple trials", "--out is missing", "presa temple trials --help lists its options");
  makeFolder(plan.out);
  const Trials trials = runTrials(plan);
  if (trials.interrupted) {
    std::fprintf(stderr, "stopped after %zu trials\n", trials.all.size());
    if (!plan.shard && !trials.all.empty()) reportTrials(plan, trials.all);
    return kExitInterrupted;
  }
  if (!plan.shard) return reportTrials(plan, trials.all);
  keepShard(plan, trials.all);
  return kExitOk;
}

void addMerge(Command trials, const std::shared_ptr<bool>& chosen, int& status) {
  struct Arguments {
    std::vector<std::string> folders;
    std::string out;
  };
  auto a = std::make_shared<Arguments>();
  Command command = trials.command("merge", "Bring the shards of trials together: the same results as on one machine");
  command.option("FOLDER", a->folders, "folders that presa temple trials --shard I/N wrote, one for each I").required();
  command.option("--out", a->out, "folder for trials.html and trials.csv").required();
  command.footer(
      "Exit status: 0 every building is whole, 1 some are not, 2 bad input.\n"
      "Example:  for i in 1 2; do presa temple trials --size first --shard $i/2 --out part_$i; done\n"
      "          presa temple trials merge part_1 part_2 --out trials");
  command.action([a, chosen, &status] {
    *chosen = true;
    status = mergeTrials(a->folders, a->out);
  });
}

void addSubmit(Command trials, const std::shared_ptr<bool>& chosen, int& status) {
  struct Arguments {
    TrialsPlan plan;
    cluster::SubmitOptions cluster;
  };
  auto a = std::make_shared<Arguments>();
  Command command =
      trials.command("submit", "Run the trials on a Slurm cluster: shards as a job array, then the merge");
  addPlanOptions(command, a->plan);
  command.option("--out", a->plan.out, "folder, seen by all nodes").required();
  cluster::addSubmitOptions(command, a->cluster);
  command.footer(
      "Exit status: 0 every building is whole, 1 some are not, or a shard never finished, 2 bad input or no cluster,\n"
      "130 Ctrl-C (the array is cancelled; --resume goes on).\n"
      "Example:  presa temple trials submit --size facade --seeds 200 --slurm --tasks 20 --out /scratch/facade");
  command.action([a, chosen, &status] {
    *chosen = true;
    status = submitTrials(a->plan, a->cluster);
  });
}

}  // namespace

void addTrials(Command app, int& status) {
  auto plan = std::make_shared<TrialsPlan>();
  auto other = std::make_shared<bool>(false);  // another command follows
  Command command = app.command("temple", "A Doric temple in blocks that two fingers can hold")
                        .command("trials", "How often, and how fast, the simulated hands rebuild the temple");
  addPlanOptions(command, *plan);
  command.option("--jobs", plan->jobs, "trials at a time (default: one per processor)").positive();
  command
      .each(
          "--shard", [plan](const std::string& text) { plan->shard = cluster::shardFrom(text); },
          "run one of N parts of the seeds, into a folder of its own; presa temple trials merge brings all N together")
      .checked(cluster::shardTrouble, "I/N");
  command.option("--out", plan->out, "folder for trials.html and trials.csv, and the output of each trial");
  command.footer(
      "Exit status: 0 every building is whole, 1 some are not, 2 bad input, 130 Ctrl-C (with a report of what was "
      "done).\n"
      "Example:  presa temple trials --size column --seeds 20 --out trials");
  addMerge(command, other, status);
  addSubmit(command, other, status);
  command.action([plan, other, &status] {
    if (!*other) status = run(*plan);
  });
}

}  // namespace presa
