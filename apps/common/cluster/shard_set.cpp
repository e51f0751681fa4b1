#include "apps/common/cluster/shard_set.h"

#include <map>

#include "apps/common/version.h"

namespace presa::cluster {
namespace {

enum SetCode { kOfAnother = 811, kMissing = 812 };

/// Why it does not belong to the first one; empty: it does.
std::string differenceOf(const ShardHead& one, const ShardHead& first) {
  if (one.version != versionText()) return "was made by Presa " + one.version + ", this is " + versionText();
  if (one.shard.count != first.shard.count)
    return "is shard " + textOf(one.shard) + ", " + first.folder + " is " + textOf(first.shard);
  if (one.work != first.work)
    return "is of another study than " + first.folder + ", or a file of the study changed between the two";
  return {};
}

}  // namespace

bool areWhole(const std::vector<ShardHead>& shards, const std::function<std::string(const Shard&)>& command,
              Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.errorCount();
  std::map<int, std::string> folders;  // by index
  for (const ShardHead& one : shards) {
    std::string wrong = differenceOf(one, shards.front());
    const auto [other, is_new] = folders.try_emplace(one.shard.index, one.folder);
    if (wrong.empty() && !is_new) wrong = "is shard " + textOf(one.shard) + ", which " + other->second + " is already";
    if (!wrong.empty())
      diagnostics.error(kOfAnother, {one.folder, 0, 0}, wrong, "name the shards of one study, each once");
  }
  if (diagnostics.errorCount() > before) return false;
  for (int i = 1; i <= shards.front().shard.count; ++i) {
    if (folders.contains(i)) continue;
    const Shard missing{i, shards.front().shard.count};
    diagnostics.error(kMissing, {"shard " + textOf(missing), 0, 0}, "is missing",
                      "name its folder, or make it: " + command(missing));
  }
  return diagnostics.errorCount() == before;
}

}  // namespace presa::cluster
