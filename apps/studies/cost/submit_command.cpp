// `presa cost submit`: the shards of a study as a job array of a cluster, merged when all are there.
#include <cstdio>

#include "apps/common/cluster/shard_file.h"
#include "apps/common/cluster/submission.h"
#include "apps/common/exit_status.h"
#include "apps/studies/cost/apply.h"
#include "apps/studies/cost/driver.h"
#include "apps/studies/cost/identity.h"
#include "apps/studies/cost/shard.h"
#include "apps/studies/cost/shard_commands.h"
#include "apps/studies/cost/study_arguments.h"

namespace presa::cost {
namespace {

constexpr const char* kCommand = "presa cost submit";

struct SubmitArguments {
  std::shared_ptr<Arguments> study = std::make_shared<Arguments>();
  cluster::SubmitOptions cluster;
  bool mixed = false;
};

cluster::ShardedWork shardedWork(const SubmitArguments& a, const Study& study) {
  std::vector<std::string> words = wordsOf(*a.study);
  words.emplace_back("--resume");
  return {.command = kCommand,
          .name = "presa_cost_" + study.name,
          .folder = study.folder + "/shards",
          .words = std::move(words),
          .is_done = [work = workOf(identityOf(study).study, a.study->instructions)](const std::string& folder,
                                                                                     const Shard& shard) {
            return cluster::holdsShard(folder, shard, work);
          }};
}

int submit(const SubmitArguments& a) {
  Diagnostics diagnostics;
  requireScene(*a.study, diagnostics);
  if (diagnostics.hasErrors()) throw InputError(std::move(diagnostics));
  const Study study = planStudy(a.study->request, diagnostics);
  if (!a.study->apply.empty()) checkApply(a.study->apply, study, diagnostics);
  cluster::checkCluster(kCommand, a.cluster, diagnostics);
  if (!study.folder.empty() && !diagnostics.hasErrors()) checkFolder(study, diagnostics);
  std::fputs(diagnostics.text().c_str(), stderr);
  if (diagnostics.hasErrors()) return kExitBadInput;

  const cluster::ShardedWork work = shardedWork(a, study);
  if (const auto status = cluster::submitShards(work, a.cluster)) return *status;
  return merge({.folders = cluster::shardFolders(work, a.cluster), .out = study.folder, .mixed = a.mixed},
               a.study->jobs, a.study->apply);
}

}  // namespace

void addSubmit(Command cost, const std::shared_ptr<bool>& chosen, int& status) {
  auto a = std::make_shared<SubmitArguments>();
  Command command = cost.command("submit", "Run a study on a Slurm cluster: shards as a job array, then the merge");
  addStudyOptions(command, a->study);
  command.named("SCENE").required();
  cluster::addSubmitOptions(command, a->cluster);
  command.flag("--mixed", a->mixed, "nodes may differ: all costs are measured again, on this machine");
  command.footer(
      "Exit status: 0 done, 1 a shard never finished or the reference could not be run, 2 bad input or no cluster,\n"
      "130 Ctrl-C (the array is cancelled; --resume goes on).\n"
      "The folder of --out must be seen by all nodes. On one node, your shards measure costs one at a time.\n"
      "Example:  presa cost submit experiments/accuracy_cost/cube_grasp.xml --slurm --tasks 16 --out /scratch/grasp");
  command.action([a, chosen, &status] {
    *chosen = true;
    status = submit(*a);
  });
}

}  // namespace presa::cost
