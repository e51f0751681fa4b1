#pragma once
#include <string>
#include <vector>

#include "apps/studies/stability/runner.h"
#include "experiments/study/jobs.h"

namespace presa::stability {

/// Results of the trials of a run, by trial; those of other shards are kNotRun.
using Results = std::vector<JobResult>;

/// What the trials of a run have in common with those of its other shards. `trials`: names of all trials of the run, in
/// order.
std::string workOf(const std::vector<std::string>& trials);

/// Keeps the results of the shard of `options` in its folder.
void writePart(const RunnerOptions& options, const std::vector<std::string>& trials, const Results& results);

/// What the folders of all shards of one run have in common.
struct Parts {
  RunnerOptions options;                                   ///< which cases
  std::vector<std::pair<std::size_t, JobResult>> results;  ///< by trial, from all shards
  std::string work;                                        ///< workOf(), as writePart saw it
};
/// Errors: E810 no shard or a damaged one, E811 shards that do not belong together, E812 a shard is missing; the result
/// is unusable if there are any.
Parts readParts(const std::vector<std::string>& folders, Diagnostics& diagnostics);

}  // namespace presa::stability
