#include "apps/common/cluster/shard_file.h"

#include <algorithm>
#include <filesystem>

#include "apps/common/atomic_file.h"
#include "apps/common/file_text.h"
#include "apps/common/version.h"

namespace presa::cluster {
namespace {

using nlohmann::json;

enum ShardCode { kNoShard = 810 };

constexpr const char *kName = "shard.json", *kFile = "/shard.json";
constexpr int kFormat = 2;

ShardFile parsed(const std::string& folder) {
  json all = json::parse(contentsOf(folder + kFile));
  if (all.at("format") != kFormat) throw std::runtime_error("another format");
  const Shard shard{all.at("shard"), all.at("shards")};
  if (!shardTrouble(textOf(shard)).empty()) throw std::runtime_error("another shard");
  return {{folder, shard, all.at("version"), all.at("work")}, std::move(all.at("content"))};
}

}  // namespace

void writeShardFile(const std::string& folder, const Shard& shard, const std::string& work, const json& content) {
  const json all{{"format", kFormat},    {"version", versionText()}, {"work", work},
                 {"shard", shard.index}, {"shards", shard.count},    {"content", content}};
  writeFileAtomically(folder + kFile, all.dump(-1, ' ', false, json::error_handler_t::replace) + "\n");
}

bool holdsShard(const std::string& folder, const Shard& shard, const std::string& work) {
  // a listing shows what a node wrote just now; asking for the file may not, on a disk in the network
  std::error_code none;
  bool there = false;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none)) there |= entry.path().filename() == kName;
  if (!there) return false;
  try {
    const ShardHead head = parsed(folder).head;
    return textOf(head.shard) == textOf(shard) && head.work == work && head.version == versionText();
  } catch (const std::exception&) {
    return false;
  }
}

void tellDamaged(const std::string& folder, Diagnostics& diagnostics) {
  diagnostics.error(kNoShard, {folder + kFile, 0, 0}, "cannot be read as a shard: it is damaged or of another release",
                    "make the shard again");
}

std::vector<ShardFile> readShards(const std::vector<std::string>& folders, const std::string& command,
                                  Diagnostics& diagnostics, const std::string& resume) {
  const std::size_t before = diagnostics.errorCount();
  std::vector<ShardFile> shards;
  std::vector<ShardHead> heads;
  for (const std::string& folder : folders) {
    if (!std::filesystem::exists(folder + kFile)) {
      diagnostics.error(kNoShard, {folder, 0, 0}, "holds no finished shard: there is no shard.json",
                        "name the folders that " + command +
                            " --shard I/N --out FOLDER wrote; repeat the command of one that was stopped" +
                            (resume.empty() ? "" : ", with " + resume));
      continue;
    }
    try {
      shards.push_back(parsed(folder));
      heads.push_back(shards.back().head);
    } catch (const std::exception&) {
      tellDamaged(folder, diagnostics);
    }
  }
  if (diagnostics.errorCount() > before) return shards;
  areWhole(
      heads, [&](const Shard& shard) { return command + " … --shard " + textOf(shard); }, diagnostics);
  std::ranges::sort(shards, {}, [](const ShardFile& one) { return one.head.shard.index; });
  return shards;
}

}  // namespace presa::cluster
