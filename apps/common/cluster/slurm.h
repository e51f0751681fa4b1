#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

/// Job arrays of a Slurm cluster, by its commands sbatch, squeue and scancel. Thread: main.
namespace presa::slurm {

/// Why no job can be submitted from here: sbatch is not on the PATH, or no controller answers. Empty: one can.
std::string trouble();

/// An array of tasks that run one script.
struct Array {
  std::string script, name, log;     ///< of the script; of the job; of a task's output, before its number and ".log"
  std::vector<int> tasks;            ///< their numbers, ascending
  std::vector<std::string> options;  ///< further ones for sbatch
};
/// Submits it; returns its number. Throws std::runtime_error with Slurm's own words.
std::string submit(const Array& array);

/// State of each task that waits or runs ("PENDING", "RUNNING"); none of an array that has ended. Null: Slurm does not
/// answer now.
std::optional<std::map<int, std::string>> tasksLeft(const std::string& number);

/// Ends all tasks of the array; false: Slurm does not answer.
bool cancel(const std::string& number);

}  // namespace presa::slurm
