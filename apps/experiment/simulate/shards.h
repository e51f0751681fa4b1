#pragma once
#include <string>
#include <vector>

#include "apps/common/cluster/submission.h"
#include "apps/experiment/simulate/simulation.h"

/// Simulated studies in parts, on several machines or on a cluster: each part runs some of the sessions.
namespace presa::experiment {

/// simulate() for one shard, into a folder of its own; its shard.json tells that all its sessions are complete.
int simulateShard(const Simulation& wanted);

/// Brings the sessions of all shards together in `out` (as links, where the disk allows), and analyses them as one
/// machine would. Returns the exit status. Throws InputError: E810 no shard or a damaged one, E811 shards that do not
/// belong together, E812 a shard is missing, E951 the folder cannot be written.
int mergeShards(const std::vector<std::string>& folders, const std::string& out);

/// Runs the shards as a job array of a cluster, then merges them. Returns the exit status. Throws InputError: E123, E813.
int submitShards(const Simulation& wanted, const cluster::SubmitOptions& on);

}  // namespace presa::experiment
