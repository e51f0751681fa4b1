#pragma once
#include <functional>
#include <string>
#include <vector>

#include "apps/common/cluster/shard.h"
#include "framework/core/diagnostics/diagnostics.h"

namespace presa::cluster {

/// A finished shard as its file tells of it.
struct ShardHead {
  std::string folder;   ///< as the user named it
  Shard shard;          ///< which part it is
  std::string version;  ///< of Presa
  std::string work;     ///< the same for all parts of one piece of work
};

/// Whether these are all parts of one piece of work, each once. `command` tells how to make a part. Errors: E811 shards
/// that do not belong together, E812 a shard is missing.
bool areWhole(const std::vector<ShardHead>& shards, const std::function<std::string(const Shard&)>& command,
              Diagnostics& diagnostics);

}  // namespace presa::cluster
