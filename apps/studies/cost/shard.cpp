#include "apps/studies/cost/shard.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "apps/common/cluster/shard_file.h"
#include "apps/common/machine.h"
#include "apps/studies/cost/driver.h"
#include "apps/studies/cost/identity.h"
#include "apps/studies/cost/run_store.h"
#include "framework/input/folders.h"

namespace presa::cost {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

enum ShardCode { kNoShard = 810, kOfAnother = 811 };

constexpr const char* kRuns = "/runs";
constexpr const char* kMixedHelp = "--mixed takes the errors of all shards and measures all costs on this machine";

/// A finished shard.
struct Part {
  std::string folder;
  Request request;                                           ///< of the study; its paths are absolute
  std::string work;                                          ///< workOf()
  bool instructions = false;                                 ///< they were counted
  std::vector<std::pair<std::string, std::string>> machine;  ///< machineFacts()
  std::size_t files = 0;                                     ///< that hold its runs
};

json toJson(const Request& request) {
  return {{"input", request.input},     {"rig", request.rig},      {"sets", request.sets}, {"knobs", request.factors},
          {"metrics", request.metrics}, {"for", request.duration}, {"seed", request.seed}, {"quick", request.quick}};
}

Part partFrom(const cluster::ShardFile& file) {
  const json &content = file.content, &stored = content.at("request");
  Part part;
  part.folder = file.head.folder;
  part.work = file.head.work;
  part.instructions = content.at("instructions");
  part.machine = content.at("machine");
  part.files = content.at("files");
  part.request.input = stored.at("input");
  part.request.rig = stored.at("rig");
  part.request.sets = stored.at("sets");
  part.request.factors = stored.at("knobs");
  part.request.metrics = stored.at("metrics");
  part.request.duration = stored.at("for");
  part.request.seed = stored.at("seed");
  part.request.quick = stored.at("quick");
  part.request.shard = file.head.shard;
  return part;
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
    if (!readAll()) return merged;
    const Part& first = shards_.front();
    Request whole = first.request;
    allowFoldersOf(whole);
    whole.shard.reset();
    whole.out = request_.out;
    merged.request = whole;
    merged.study = planStudy(whole, diagnostics_);
    if (diagnostics_.hasErrors()) return merged;
    identity_ = identityOf(merged.study);
    if (workOf(identity_.study, first.instructions) != first.work)
      return refuse(kOfAnother, {whole.input, 0, 0}, "the study is not as it was when its shards were made",
                    "undo the change, or make the shards again"),
             merged;
    for (const Part& shard : shards_) {
      if (fs::weakly_canonical(shard.folder) != fs::weakly_canonical(merged.study.folder)) continue;
      refuse(kOfAnother, {"--out " + merged.study.folder, 0, 0},
             "is the folder of shard " + textOf(*shard.request.shard), "choose another with --out");
    }
    checkRuns(merged.study);
    if (diagnostics_.hasErrors()) return merged;
    merged.instructions = first.instructions;
    if (!request_.mixed) merged.machine = first.machine;
    checkFolder(merged.study, diagnostics_);
    if (!diagnostics_.hasErrors()) copyRuns(merged.study.folder + kRuns);
    return merged;
  }

 private:
  void refuse(int code, const SourceLocation& where, const std::string& what, const std::string& help) {
    diagnostics_.error(code, where, what, help);
  }

  bool readAll() {
    for (const cluster::ShardFile& file :
         cluster::readShards(request_.folders, "presa cost STUDY", diagnostics_, "--resume")) {
      try {
        shards_.push_back(partFrom(file));
      } catch (const std::exception&) {
        cluster::tellDamaged(file.head.folder, diagnostics_);
      }
    }
    return !diagnostics_.hasErrors();
  }

  RunStore storeOf(const Part& shard) const { return {shard.folder + kRuns, identity_.common}; }

  /// Every run of every shard is there and can be read, and all costs come from one kind of machine.
  void checkRuns(const Study& study) {
    std::map<std::string, std::string> hardware;  // of costs, with a folder that has it
    for (const Part& shard : shards_) {
      const Shard& its = *shard.request.shard;
      try {
        if (filesIn(shard.folder) != shard.files) throw std::runtime_error("a file is lost");
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
               "make it again: " + commandFor(shard.request, its));
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
    for (const Part& shard : shards_) {
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
  std::vector<Part> shards_;
  Identity identity_;
};

}  // namespace

std::string workOf(std::uint64_t study, bool instructions) {
  return std::to_string(study) + (instructions ? " counted" : "");
}

void writeShard(const Study& study, const Request& request, bool instructions) {
  Request absolute = request;  // the merge may run in another folder
  absolute.input = fs::absolute(request.input).lexically_normal().string();
  if (!request.rig.empty()) absolute.rig = fs::absolute(request.rig).lexically_normal().string();
  cluster::writeShardFile(study.folder, *request.shard, workOf(identityOf(study).study, instructions),
                          {{"instructions", instructions},
                           {"machine", machineFacts()},
                           {"files", filesIn(study.folder)},
                           {"request", toJson(absolute)}});
}

Merged mergeShards(const MergeRequest& request, Diagnostics& diagnostics) { return Merge(request, diagnostics).run(); }

}  // namespace presa::cost
