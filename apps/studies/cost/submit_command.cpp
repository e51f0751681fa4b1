// `presa cost submit`: the shards of a study as a job array of a cluster, merged when all are there.
#include <cstdio>
#include <filesystem>

#include "apps/common/cluster/array_run.h"
#include "apps/common/cluster/slurm.h"
#include "apps/common/exit_status.h"
#include "apps/common/shell.h"
#include "apps/studies/cost/apply.h"
#include "apps/studies/cost/driver.h"
#include "apps/studies/cost/identity.h"
#include "apps/studies/cost/shard.h"
#include "apps/studies/cost/shard_commands.h"
#include "apps/studies/cost/study_arguments.h"
#include "framework/core/diagnostics/refuse.h"

namespace presa::cost {
namespace {

namespace fs = std::filesystem;

enum SubmitCode { kNoCluster = 813, kShardsFailed = 814 };

struct SubmitArguments {
  std::shared_ptr<Arguments> study = std::make_shared<Arguments>();
  int tasks = 8, retries = 2;
  bool slurm = false, mixed = false;
  std::vector<std::string> options;  ///< for sbatch
};

slurm::ArrayRun arrayOf(const SubmitArguments& a, const Study& study, std::uint64_t identity) {
  const std::string shards = study.folder + "/shards";
  std::string program = (fs::read_symlink("/proc/self/exe").parent_path() / "presa").string();
  std::string command = shell::quoted(program);
  for (const std::string& word : wordsOf(*a.study)) command += " " + shell::quoted(word);
  return {.name = "presa_cost_" + study.name,
          .folder = shards,
          .parts = a.tasks,
          .command =
              [command, shards, tasks = std::to_string(a.tasks)](const std::string& part) {
                return command + " --shard \"" + part + "/" + tasks + "\" --out " + shell::quoted(shards + "/") + "\"" +
                       part + "\" --jobs \"${SLURM_CPUS_PER_TASK:-1}\" --resume";
              },
          .is_done =
              [shards, identity, tasks = a.tasks, counted = a.study->instructions](int part) {
                return holdsShard(shards + "/" + std::to_string(part), {part, tasks}, identity, counted);
              },
          .retries = a.retries,
          .options = a.options};
}

int tellFailed(const slurm::ArrayRun& array, const std::vector<int>& failed) {
  Diagnostics diagnostics;
  for (const int part : failed) {
    diagnostics.error(
        kShardsFailed, {"shard " + textOf(Shard{part, array.parts}), 0, 0},
        "never finished, after " + std::to_string(array.retries + 1) + (array.retries == 0 ? " attempt" : " attempts"),
        "its output is in " + slurm::logOf(array, part) + "; --resume keeps all that was done");
  }
  std::fputs(diagnostics.text().c_str(), stderr);
  return kExitFault;
}

int submit(const SubmitArguments& a) {
  Diagnostics diagnostics;
  requireScene(*a.study, diagnostics);
  if (!a.slurm) diagnostics.error(123, {"presa cost submit", 0, 0}, "needs the kind of cluster, found none", "--slurm");
  if (diagnostics.hasErrors()) throw InputError(std::move(diagnostics));
  const Study study = planStudy(a.study->request, diagnostics);
  if (!a.study->apply.empty()) checkApply(a.study->apply, study, diagnostics);
  if (const std::string trouble = slurm::trouble(); !trouble.empty())
    diagnostics.error(kNoCluster, {"presa cost submit", 0, 0}, "no job can be submitted from here: " + trouble,
                      "call it where sbatch works, or make the shards yourself: presa cost … --shard I/N");
  if (!study.folder.empty() && !diagnostics.hasErrors()) checkFolder(study.folder, diagnostics);
  std::fputs(diagnostics.text().c_str(), stderr);
  if (diagnostics.hasErrors()) return kExitBadInput;

  const slurm::ArrayRun array = arrayOf(a, study, identityOf(study).study);
  const std::string before = array.folder + ".before";  // until Slurm has taken the job
  if (!a.study->resume && fs::exists(array.folder)) {
    fs::remove_all(before);
    fs::rename(array.folder, before);
  }
  fs::create_directories(array.folder);
  slurm::ArrayEnd end;
  try {
    end = slurm::runArray(array);
    fs::remove_all(before);
  } catch (const std::runtime_error& error) {
    if (fs::exists(before)) {
      fs::remove_all(array.folder);
      fs::rename(before, array.folder);
    }
    refuse(kNoCluster, "presa cost submit", std::string("Slurm refuses the job: ") + error.what(),
           "--sbatch OPTION gives options to sbatch, such as --sbatch=--partition=NAME");
  }
  if (end.interrupted) return interrupted(study.folder, "the same command and --resume");
  if (!end.failed.empty()) return tellFailed(array, end.failed);

  MergeRequest request{.folders = {}, .out = study.folder, .mixed = a.mixed};
  for (int part = 1; part <= a.tasks; ++part) request.folders.push_back(array.folder + "/" + std::to_string(part));
  return merge(request, a.study->jobs, a.study->apply);
}

}  // namespace

void addSubmit(Command cost, const std::shared_ptr<bool>& chosen, int& status) {
  auto a = std::make_shared<SubmitArguments>();
  Command command = cost.command("submit", "Run a study on a Slurm cluster: shards as a job array, then the merge");
  addStudyOptions(command, a->study);
  command.named("SCENE").required();
  command.flag("--slurm", a->slurm, "the cluster is one of Slurm: required, so that scripts say what they rely on");
  command.option("--tasks", a->tasks, "shards, each a task of the array").withinCount(1, 10000).showDefault();
  command
      .option("--sbatch", a->options,
              "option for sbatch, such as --sbatch=--partition=short or --sbatch=--cpus-per-task=4; may be repeated")
      .oneValueEach();
  command.option("--retries", a->retries, "how often a shard that fails is submitted again")
      .withinCount(0, 100)
      .showDefault();
  command.flag("--mixed", a->mixed, "nodes may differ: all costs are measured again, on this machine");
  command.flag("--resume", a->study->resume, "keep what an interrupted submission has made");
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
