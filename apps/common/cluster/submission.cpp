#include "apps/common/cluster/submission.h"

#include <cstdio>
#include <filesystem>

#include "apps/common/cluster/array_run.h"
#include "apps/common/cluster/slurm.h"
#include "apps/common/exit_status.h"
#include "apps/common/shell.h"
#include "framework/core/diagnostics/refuse.h"

namespace presa::cluster {
namespace {

namespace fs = std::filesystem;

enum SubmitCode { kNoCluster = 813, kShardFailed = 814 };

std::string folderOf(const ShardedWork& work, int part) { return work.folder + "/" + std::to_string(part); }

slurm::ArrayRun arrayOf(const ShardedWork& work, const SubmitOptions& options) {
  std::string command = shell::quoted((fs::read_symlink("/proc/self/exe").parent_path() / "presa").string());
  for (const std::string& word : work.words) command += " " + shell::quoted(word);
  return {.name = work.name,
          .folder = work.folder,
          .parts = options.tasks,
          .command =
              [command, folder = work.folder, tasks = std::to_string(options.tasks)](const std::string& part) {
                return command + " --shard \"" + part + "/" + tasks + "\" --out " + shell::quoted(folder + "/") + "\"" +
                       part + "\" --jobs \"${SLURM_CPUS_PER_TASK:-1}\"";
              },
          .is_done =
              [&work, tasks = options.tasks](int part) {
                return work.is_done(folderOf(work, part), {part, tasks});
              },
          .on_taken = [] {},
          .retries = options.retries,
          .options = options.options};
}

void tellFailed(const slurm::ArrayRun& array, const std::vector<int>& failed) {
  Diagnostics diagnostics;
  for (const int part : failed) {
    diagnostics.error(
        kShardFailed, {"shard " + textOf(Shard{part, array.parts}), 0, 0},
        "never finished, after " + std::to_string(array.retries + 1) + (array.retries == 0 ? " attempt" : " attempts"),
        "its output is in " + slurm::logOf(array, part) + "; --resume keeps what is finished");
  }
  std::fputs(diagnostics.text().c_str(), stderr);
}

}  // namespace

void addSubmitOptions(Command command, SubmitOptions& options) {
  command.flag("--slurm", options.slurm,
               "the cluster is one of Slurm: required, so that scripts say what they rely on");
  command.option("--tasks", options.tasks, "shards, each a task of the array").withinCount(1, 10000).showDefault();
  command
      .option("--sbatch", options.options,
              "option for sbatch, such as --sbatch=--partition=short or --sbatch=--cpus-per-task=4; may be repeated")
      .oneValueEach();
  command.option("--retries", options.retries, "how often a shard that fails is submitted again")
      .withinCount(0, 100)
      .showDefault();
  command.flag("--resume", options.resume, "keep what an interrupted submission has made");
}

void checkCluster(const std::string& command, const SubmitOptions& options, Diagnostics& diagnostics) {
  if (!options.slurm) {
    diagnostics.error(123, {command, 0, 0}, "needs the kind of cluster, found none", "--slurm");
    return;
  }
  if (const std::string trouble = slurm::trouble(); !trouble.empty())
    diagnostics.error(kNoCluster, {command, 0, 0}, "no job can be submitted from here: " + trouble,
                      "call it where sbatch works, or make the shards yourself: --shard I/N");
}

std::optional<int> submitShards(const ShardedWork& work, const SubmitOptions& options) {
  slurm::ArrayRun array = arrayOf(work, options);
  const std::string before = array.folder + ".before";  // until Slurm has taken the job
  if (!options.resume && fs::exists(array.folder)) {
    fs::remove_all(before);
    fs::rename(array.folder, before);
  }
  fs::create_directories(array.folder);
  bool taken = false;
  array.on_taken = [&] {
    taken = true;
    std::error_code stays;  // such as a file that another node still has open
    fs::remove_all(before, stays);
  };
  slurm::ArrayEnd end;
  try {
    end = slurm::runArray(array);
  } catch (const std::runtime_error& error) {
    if (taken) throw;
    if (fs::exists(before)) {
      fs::remove_all(array.folder);
      fs::rename(before, array.folder);
    }
    refuse(kNoCluster, work.command, std::string("Slurm refuses the job: ") + error.what(),
           "--sbatch OPTION gives options to sbatch, such as --sbatch=--partition=NAME");
  }
  if (end.interrupted) {
    std::fprintf(stderr, "stopped; the shards that are done are in %s: the same command with --resume goes on\n",
                 work.folder.c_str());
    return kExitInterrupted;
  }
  if (end.failed.empty()) return std::nullopt;
  tellFailed(array, end.failed);
  return kExitFault;
}

std::vector<std::string> shardFolders(const ShardedWork& work, const SubmitOptions& options) {
  std::vector<std::string> folders;
  for (int part = 1; part <= options.tasks; ++part) folders.push_back(folderOf(work, part));
  return folders;
}

}  // namespace presa::cluster
