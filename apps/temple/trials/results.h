#pragma once
#include <string>
#include <vector>

#include "apps/common/cluster/submission.h"
#include "apps/temple/trials/trials.h"

namespace presa::temple {

/// Writes OUT/trials.csv and OUT/trials.html, and prints how often the building was whole. Returns the exit status:
/// 1 unless it always was.
int reportTrials(const TrialsPlan& plan, const std::vector<Trial>& trials);

/// Keeps the trials of the plan's shard in its folder, for the merge.
void keepShard(const TrialsPlan& plan, const std::vector<Trial>& trials);

/// Reports the trials of all shards, into `out`. Returns the exit status. Throws InputError: E810 no shard or a damaged one, E811
/// shards that do not belong together, E812 a shard is missing.
int mergeTrials(const std::vector<std::string>& folders, const std::string& out);

/// Runs the shards as a job array of a cluster, then merges them. Returns the exit status. Throws InputError: E123, E813.
int submitTrials(const TrialsPlan& plan, const cluster::SubmitOptions& on);

}  // namespace presa::temple
