#pragma once
#include <functional>
#include <string>
#include <vector>

namespace presa::slurm {

/// Parts of one piece of work, numbered from 1, each made by a task of a job array.
struct ArrayRun {
  std::string name;    ///< of the job, as squeue shows it
  std::string folder;  ///< for the script and the tasks' output; seen by all nodes
  int parts = 1;       ///< number of them
  std::function<std::string(const std::string& part)> command;  ///< shell line for a part, given as a shell expression
  std::function<bool(int part)> is_done;                        ///< asked often
  std::function<void()> on_taken;                               ///< called when Slurm has taken the job
  int retries = 2;                                              ///< how often a failed part is submitted again
  std::vector<std::string> options;                             ///< for sbatch
};

/// How it ended.
struct ArrayEnd {
  bool interrupted = false;  ///< by Ctrl-C: all tasks are cancelled
  std::vector<int> failed;   ///< parts that were submitted `retries` times more, in vain
};

/// Submits the parts that are not done, shows progress, submits again what failed, and returns when all are done, or
/// nothing is left to try. Throws std::runtime_error with Slurm's own words when it refuses the job; where it refuses to
/// take failed parts again, that is told on stderr, and they have failed.
ArrayEnd runArray(const ArrayRun& run);

/// File with the output of a part.
std::string logOf(const ArrayRun& run, int part);

}  // namespace presa::slurm
