#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

/// Job arrays of a Slurm cluster, by its commands sbatch, squeue and scancel. Thread: main.
namespace presa::slurm {

/// Why no job can be submitted from here: sbatch is not on the PATH, or no controller answers. Empty: one can.
std::string trouble();

/// Submits the script as an array of these tasks; `options` go to sbatch before the script. Returns the array's number.
/// Throws std::runtime_error with Slurm's own words.
std::string submit(const std::string& script, const std::vector<int>& tasks, const std::vector<std::string>& options);

/// State of each task that waits or runs ("PENDING", "RUNNING"); none of an array that has ended. Null: Slurm does not
/// answer now.
std::optional<std::map<int, std::string>> tasksLeft(const std::string& array);

/// Ends all tasks of the array.
void cancel(const std::string& array);

}  // namespace presa::slurm
