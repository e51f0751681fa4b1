#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/common/cluster/shard_set.h"

namespace presa::cluster {

/// FOLDER/shard.json, which tells that a shard is finished.
struct ShardFile {
  ShardHead head;
  nlohmann::json content;  ///< what its command wrote
};

/// Writes it, of this release. `work`: the same for all shards of one piece of work.
void writeShardFile(const std::string& folder, const Shard& shard, const std::string& work,
                    const nlohmann::json& content);

/// Whether the folder holds that finished shard, of this release.
bool holdsShard(const std::string& folder, const Shard& shard, const std::string& work);

/// The shards of one piece of work, each once, by rising index. `command`, such as "presa stability", made them;
/// `resume`: the option with which one that was stopped goes on, if there is one. Errors, all at once: E810 no shard or a
/// damaged one, E811 shards that do not belong together, E812 a shard is missing; then the result is unusable.
std::vector<ShardFile> readShards(const std::vector<std::string>& folders, const std::string& command,
                                  Diagnostics& diagnostics, const std::string& resume = {});

/// E810: the shard in a folder cannot be read.
void tellDamaged(const std::string& folder, Diagnostics& diagnostics);

}  // namespace presa::cluster
