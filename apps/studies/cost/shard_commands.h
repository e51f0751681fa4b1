#pragma once
#include <memory>
#include <string>

#include "apps/common/options/command_line.h"
#include "apps/studies/cost/shard.h"

namespace presa::cost {

/// Merges shards, and writes and prints the results. `jobs`: watched runs at a time, 0: one per processor. Returns the
/// exit status.
int merge(const MergeRequest& request, int jobs, const std::string& apply);

/// Adds `presa cost merge`; it sets `chosen` when it runs.
void addMerge(Command cost, const std::shared_ptr<bool>& chosen, int& status);
/// Adds `presa cost submit`, likewise.
void addSubmit(Command cost, const std::shared_ptr<bool>& chosen, int& status);

}  // namespace presa::cost
