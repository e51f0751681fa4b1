#pragma once
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "apps/studies/cost/plan.h"

namespace presa::cost {

/// The work that a shard of a study (Identity::study) is a part of, for cluster::holdsShard(). `instructions`: they are
/// counted.
std::string workOf(std::uint64_t study, bool instructions);

/// Writes the file of a shard whose runs are done, in the study's folder; a folder without it holds no finished shard.
void writeShard(const Study& study, const Request& request, bool instructions);

struct MergeRequest {
  std::vector<std::string> folders;  ///< of the shards
  std::string out;                   ///< folder of the merged study; empty: cost_NAME
  bool mixed = false;                ///< shards of several machines: their costs are left out, and measured here
};

/// A study whose runs lie in its folder.
struct Merged {
  Request request;  ///< of the whole study
  Study study;
  bool instructions = false;                                 ///< they were counted
  std::vector<std::pair<std::string, std::string>> machine;  ///< that all costs come from; empty: to be measured here
};

/// Brings the runs of all shards of one study together in its folder. Errors, all at once and before anything is
/// written: E810 no shard or a damaged one, E811 shards that do not belong together, E812 a shard is missing. The
/// result is unusable if there are any.
Merged mergeShards(const MergeRequest& request, Diagnostics& diagnostics);

}  // namespace presa::cost
