#pragma once
#include <optional>
#include <string>
#include <vector>

#include "apps/common/cluster/shard.h"
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

}  // namespace presa::stability
