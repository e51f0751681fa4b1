#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/common/cluster/shard.h"
#include "apps/common/options/command_line.h"
#include "framework/core/diagnostics/diagnostics.h"

/// `presa … submit`: a piece of work as shards on a cluster, each a task of a job array. Thread: main.
namespace presa::cluster {

struct SubmitOptions {
  int tasks = 8, retries = 2;
  bool slurm = false;                ///< required: scripts say what they rely on
  bool resume = false;               ///< keep what an interrupted submission has made
  std::vector<std::string> options;  ///< for sbatch
};
/// Adds --slurm, --tasks, --sbatch, --retries and --resume. `options` lives until the program ends.
void addSubmitOptions(Command command, SubmitOptions& options);

/// Before any work: E123 without --slurm, E813 where no job can be submitted. `command`: "presa cost submit".
void checkCluster(const std::string& command, const SubmitOptions& options, Diagnostics& diagnostics);

/// Work of which `presa WORDS --shard I/N --out FOLDER/I --jobs J` makes a shard.
struct ShardedWork {
  std::string command;             ///< that submits it: "presa cost submit"
  std::string name;                ///< of the job, as squeue shows it
  std::string folder;              ///< for the shards; seen by all nodes
  std::vector<std::string> words;  ///< of the command that makes a shard, with absolute paths
  std::function<bool(const std::string& folder, const Shard& shard)> is_done;  ///< asked often
};

/// Submits the shards that are not done, follows them, and submits again what failed. No value: all are done. Otherwise
/// the exit status, with the reason on stderr: a shard never finished (E814), or Ctrl-C. Throws InputError E813 with Slurm's own words when it refuses the job; what an earlier
/// submission made is there as before, then.
std::optional<int> submitShards(const ShardedWork& work, const SubmitOptions& options);

/// Folders of all shards, in order.
std::vector<std::string> shardFolders(const ShardedWork& work, const SubmitOptions& options);

}  // namespace presa::cluster
