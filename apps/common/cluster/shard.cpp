#include "apps/common/cluster/shard.h"

#include <charconv>

#include "framework/core/diagnostics/printable.h"

namespace presa::cluster {

constexpr int kMostShards = 100000;

std::string textOf(const Shard& shard) { return std::to_string(shard.index) + "/" + std::to_string(shard.count); }

std::string shardTrouble(const std::string& text) {
  Shard shard;
  const char* const end = text.data() + text.size();
  const auto index = std::from_chars(text.data(), end, shard.index);
  const bool slash = index.ec == std::errc() && index.ptr != end && *index.ptr == '/';
  const auto count = slash ? std::from_chars(index.ptr + 1, end, shard.count) : index;
  const bool good = slash && count.ec == std::errc() && count.ptr == end && shard.index >= 1 &&
                    shard.index <= shard.count && shard.count <= kMostShards;
  return good ? "" : "expects I/N with I from 1 to N, as 2/8, found '" + printable(text) + "'";
}

Shard shardFrom(const std::string& text) {
  const std::size_t slash = text.find('/');
  return {std::stoi(text.substr(0, slash)), std::stoi(text.substr(slash + 1))};
}

}  // namespace presa::cluster
