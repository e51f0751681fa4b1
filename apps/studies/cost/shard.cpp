#include "apps/studies/cost/shard.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "apps/common/atomic_file.h"
#include "apps/common/cluster/shard_set.h"
#include "apps/common/file_text.h"
#include "apps/common/machine.h"
#include "apps/common/version.h"
#include "apps/studies/cost/driver.h"
#include "apps/studies/cost/identity.h"
#include "apps/studies/cost/run_store.h"
#include "framework/input/folders.h"

namespace presa::cost {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

enum ShardCode { kNoShard = 810, kOfAnother = 811 };

constexpr const char *kFile = "/shard.json", *kRuns = "/runs";
constexpr int kFormat = 1;
constexpr const char* kMixedHelp = "--mixed takes the errors of all shards and measures all costs on this machine";

json toJson(const Request& request) {
  return {{"input", request.input},        {"rig", request.rig},         {"sets", request.sets},
          {"knobs", request.factors},      {"metrics", request.metrics}, {"for", request.duration},
          {"seed", request.seed},          {"quick", request.quick},     {"shard", request.shard->index},
          {"shards", request.shard->count}};
}

Request requestFrom(const json& stored) {
  Request request;
  request.input = stored.at("input");
  request.rig = stored.at("rig");
  request.sets = stored.at("sets");
  request.factors = stored.at("knobs");
  request.metrics = stored.at("metrics");
  request.duration = stored.at("for");
  request.seed = stored.at("seed");
  request.quick = stored.at("quick");
  request.shard = {stored.at("shard"), stored.at("shards")};
  return request;
}

ShardFile shardFileFrom(const json& stored) {
  if (stored.at("format") != kFormat) throw std::runtime_error("another format");
  ShardFile file{.request = requestFrom(stored.at("request")),
                 .study = stored.at("study"),
                 .version = stored.at("version"),
                 .instructions = stored.at("instructions"),
                 .machine = stored.at("machine"),
                 .files = stored.at("files")};
  const Shard& shard = *file.request.shard;
  if (shard.count < 1 || shard.index < 1 || shard.index > shard.count) throw std::runtime_error("another shard");
  return file;
}

std::size_t filesIn(const std::string& folder) {
  std::error_code none;
  const fs::directory_iterator all(folder + kRuns, none);
  return static_cast<std::size_t>(std::distance(begin(all), end(all)));
}

/// The command line of a shard allowed the folders of its files.
void allowFoldersOf(const Request& request) {
  std::vector<std::string> words{"presa", request.input, request.rig};
  words.insert(words.end(), request.sets.begin(), request.sets.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  input::allowFoldersOf(static_cast<int>(pointers.size()), pointers.data());
}

/// How to make a shard.
std::string commandFor(const Request& request, const Shard& shard) {
  return "presa cost " + request.input + " … --shard " + textOf(shard);
}

class Merge {
 public:
  Merge(const MergeRequest& request, Diagnostics& diagnostics) : request_(request), diagnostics_(diagnostics) {}

  Merged run() {
    Merged merged;
    if (!readAll() || !belongTogether()) return merged;
    Request whole = shards_.front().file.request;
    allowFoldersOf(whole);
    whole.shard.reset();
    whole.out = request_.out;
    merged.request = whole;
    merged.study = planStudy(whole, diagnostics_);
    if (diagnostics_.hasErrors()) return merged;
    identity_ = identityOf(merged.study);
    if (identity_.study != shards_.front().file.study)
      return refuse(kOfAnother, {whole.input, 0, 0}, "the study is not as it was when its shards were made",
                    "undo the change, or make the shards again"),
             merged;
    for (const Read& shard : shards_) {
      if (fs::weakly_canonical(shard.folder) != fs::weakly_canonical(merged.study.folder)) continue;
      refuse(kOfAnother, {"--out " + merged.study.folder, 0, 0},
             "is the folder of shard " + textOf(*shard.file.request.shard), "choose another with --out");
    }
    checkRuns(merged.study);
    if (diagnostics_.hasErrors()) return merged;
    merged.instructions = shards_.front().file.instructions;
    if (!request_.mixed) merged.machine = shards_.front().file.machine;
    checkFolder(merged.study.folder, diagnostics_);
    if (!diagnostics_.hasErrors()) copyRuns(merged.study.folder + kRuns);
    return merged;
  }

 private:
  struct Read {
    std::string folder;
    ShardFile file;
  };

  void refuse(int code, const SourceLocation& where, const std::string& what, const std::string& help) {
    diagnostics_.error(code, where, what, help);
  }

  bool readAll() {
    for (const std::string& folder : request_.folders) {
      const std::string file = folder + kFile;
      if (!fs::exists(file)) {
        refuse(kNoShard, {folder, 0, 0}, "holds no finished shard: there is no shard.json",
               fs::exists(folder + kRuns) ? "it was stopped; repeat its command with --resume"
                                          : "name the folders that presa cost --shard I/N --out FOLDER wrote");
        continue;
      }
      try {
        shards_.push_back({folder, shardFileFrom(json::parse(contentsOf(file)))});
      } catch (const std::exception&) {
        refuse(kNoShard, {file, 0, 0}, "cannot be read as a shard: it is damaged or of another release",
               "make the shard again");
      }
    }
    return !diagnostics_.hasErrors();
  }

  bool belongTogether() {
    std::vector<cluster::ShardHead> heads;
    for (const Read& shard : shards_)
      heads.push_back({shard.folder, *shard.file.request.shard, shard.file.version,
                       std::to_string(shard.file.study) + (shard.file.instructions ? " counted" : "")});
    const Read& first = shards_.front();
    return cluster::areWhole(
        heads, [&](const Shard& shard) { return commandFor(first.file.request, shard); }, diagnostics_);
  }

  RunStore storeOf(const Read& shard) const { return {shard.folder + kRuns, identity_.common}; }

  /// Every run of every shard is there and can be read, and all costs come from one kind of machine.
  void checkRuns(const Study& study) {
    std::map<std::string, std::string> hardware;  // of costs, with a folder that has it
    for (const Read& shard : shards_) {
      const Shard& its = *shard.file.request.shard;
      try {
        if (filesIn(shard.folder) != shard.file.files) throw std::runtime_error("a file is lost");
        for (std::size_t i = 0; i < study.settings.size(); ++i) {
          const Setting& setting = study.settings[i];
          if (!its.holds(i) || !setting.impossible.empty()) continue;
          const RunStore store = storeOf(shard);
          if (!store.evidence(setting.scene_hash, true).failure.empty()) continue;
          for (int repeat = 0; repeat < study.repeats; ++repeat)
            hardware[store.timing(setting.scene_hash, repeat).hardware] = shard.folder;
        }
        for (std::size_t level = 0; level < std::min(kFirstLevels, identity_.levels.size()); ++level)
          if (its.holds(level)) storeOf(shard).evidence(identity_.levels[level], true);
      } catch (const std::exception&) {
        refuse(kNoShard, {shard.folder, 0, 0},
               "is damaged: a run of shard " + textOf(its) + " is lost or cannot be read",
               "make it again: " + commandFor(shard.file.request, its));
      }
    }
    if (request_.mixed || hardware.size() < 2) return;
    const auto &first = *hardware.begin(), &other = *std::next(hardware.begin());
    refuse(kOfAnother, {first.second, 0, 0},
           "has costs of another machine than " + other.second + ": " + first.first + ", and " + other.first,
           kMixedHelp);
  }

  void copyRuns(const std::string& to) {
    fs::create_directories(to);  // a merge that was stopped goes on with what it has measured
    for (const Read& shard : shards_) {
      for (const auto& entry : fs::directory_iterator(shard.folder + kRuns)) {
        const std::string name = entry.path().filename().string();
        const bool cost = name.find(".time") != std::string::npos;
        if (!(cost && request_.mixed))
          fs::copy_file(entry.path(), to + "/" + name, fs::copy_options::overwrite_existing);
      }
    }
  }

  const MergeRequest& request_;
  Diagnostics& diagnostics_;
  std::vector<Read> shards_;
  Identity identity_;
};

}  // namespace

bool holdsShard(const std::string& folder, const Shard& shard, std::uint64_t study, bool instructions) {
  // listing the folder shows what another machine has just written there; asking for the file may not
  std::error_code none;
  bool listed = false;
  for (const auto& entry : fs::directory_iterator(folder, none)) listed = listed || entry.path() == folder + kFile;
  if (!listed) return false;
  try {
    const ShardFile file = shardFileFrom(json::parse(contentsOf(folder + kFile)));
    const Shard& its = *file.request.shard;
    return its.index == shard.index && its.count == shard.count && file.study == study &&
           file.instructions == instructions && file.version == versionText();
  } catch (const std::exception&) {
    return false;
  }
}

void writeShardFile(const Study& study, const Request& request, bool instructions) {
  Request absolute = request;  // the merge may run in another folder
  absolute.input = fs::absolute(request.input).lexically_normal().string();
  if (!request.rig.empty()) absolute.rig = fs::absolute(request.rig).lexically_normal().string();
  const json all{{"format", kFormat},
                 {"version", versionText()},
                 {"study", identityOf(study).study},
                 {"instructions", instructions},
                 {"machine", machineFacts()},
                 {"files", filesIn(study.folder)},
                 {"request", toJson(absolute)}};
  writeFileAtomically(study.folder + kFile, all.dump(1) + "\n");
}

Merged mergeShards(const MergeRequest& request, Diagnostics& diagnostics) { return Merge(request, diagnostics).run(); }

}  // namespace presa::cost
