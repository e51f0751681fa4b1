#pragma once
#include <optional>
#include <string>
#include <vector>

#include "apps/common/cluster/shard.h"
#include "apps/common/cluster/submission.h"
#include "experiments/stability/case.h"

namespace presa::stability {

/// Options of the command line.
struct RunnerOptions {
  std::vector<std::string> cases;  ///< empty: all
  bool list = false;
  bool quick = false;
  std::string out;  ///< output folder; empty: none
  std::string format = "text";
  int jobs = 0;
  std::optional<cluster::Shard> shard{};  ///< none: all trials
};

/// Runs the cases of `all` that the options select; returns the exit status. Throws InputError for unknown names and
/// bad folders, before any work.
int runCases(const RunnerOptions& options, std::vector<Case> all = allCases());
/// Brings the shards of one run together, in the folder and the format of `options`; returns the exit status of the whole
/// run. Throws InputError: E810 to E812.
int mergeCases(const std::vector<std::string>& folders, const RunnerOptions& options,
               std::vector<Case> all = allCases());
/// Runs the shards as a job array of a cluster, then merges them; returns the exit status of the whole run, or 1 where a
/// shard never finished. Throws InputError: E123, E813.
int submitCases(const RunnerOptions& options, const cluster::SubmitOptions& on);

}  // namespace presa::stability
