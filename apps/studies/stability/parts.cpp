#include "apps/studies/stability/parts.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/common/atomic_file.h"
#include "apps/common/cluster/shard_set.h"
#include "apps/common/file_text.h"
#include "apps/common/version.h"
#include "framework/core/math/fnv.h"

namespace presa::stability {
namespace {

using nlohmann::json;

enum PartCode { kNoShard = 810 };

constexpr const char* kFile = "/shard.json";
constexpr int kFormat = 1;

json toJson(std::size_t trial, const JobResult& result) {
  return {trial, static_cast<int>(result.outcome), result.text, result.seconds};
}

std::pair<std::size_t, JobResult> resultFrom(const json& stored) {
  JobResult result;
  result.outcome = static_cast<JobResult::Outcome>(stored.at(1).get<int>());
  result.text = stored.at(2);
  result.seconds = stored.at(3);
  return {stored.at(0), result};
}

}  // namespace

std::string workOf(const std::vector<std::string>& trials) {
  Fnv1a hash;
  for (const std::string& trial : trials) hash.add(trial + "\n");
  return std::to_string(hash.value());
}

void writePart(const std::string& folder, const RunnerOptions& options, const std::vector<std::string>& trials,
               const Results& results) {
  json stored = json::array();
  for (std::size_t i = 0; i < results.size(); ++i)
    if (results[i].outcome != JobResult::Outcome::kNotRun) stored.push_back(toJson(i, results[i]));
  const json all{{"format", kFormat},
                 {"version", versionText()},
                 {"work", workOf(trials)},
                 {"cases", options.cases},
                 {"quick", options.quick},
                 {"shard", options.shard->index},
                 {"shards", options.shard->count},
                 {"results", std::move(stored)}};
  writeFileAtomically(folder + kFile, all.dump() + "\n");
}

Parts readParts(const std::vector<std::string>& folders, Diagnostics& diagnostics) {
  Parts parts;
  std::vector<cluster::ShardHead> heads;
  for (const std::string& folder : folders) {
    if (!std::filesystem::exists(folder + kFile)) {
      diagnostics.error(kNoShard, {folder, 0, 0}, "holds no finished shard: there is no shard.json",
                        "name the folders that presa stability --shard I/N --out FOLDER wrote");
      continue;
    }
    try {
      const json all = json::parse(contentsOf(folder + kFile));
      if (all.at("format") != kFormat) throw std::runtime_error("another format");
      heads.push_back({folder, {all.at("shard"), all.at("shards")}, all.at("version"), all.at("work")});
      parts.work = all.at("work");
      parts.options.cases = all.at("cases");
      parts.options.quick = all.at("quick");
      for (const json& stored : all.at("results")) parts.results.push_back(resultFrom(stored));
    } catch (const std::exception&) {
      diagnostics.error(kNoShard, {folder + kFile, 0, 0},
                        "cannot be read as a shard: it is damaged or of another release", "make the shard again");
    }
  }
  if (diagnostics.hasErrors()) return parts;
  cluster::areWhole(
      heads, [](const cluster::Shard& shard) { return "presa stability … --shard " + cluster::textOf(shard); },
      diagnostics);
  return parts;
}

}  // namespace presa::stability
