#include "apps/studies/stability/parts.h"

#include "apps/common/cluster/shard_file.h"
#include "framework/core/math/fnv.h"

namespace presa::stability {
namespace {

using nlohmann::json;

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

void writePart(const RunnerOptions& options, const std::vector<std::string>& trials, const Results& results) {
  json stored = json::array();
  for (std::size_t i = 0; i < results.size(); ++i)
    if (results[i].outcome != JobResult::Outcome::kNotRun) stored.push_back(toJson(i, results[i]));
  cluster::writeShardFile(options.out, *options.shard, workOf(trials),
                          {{"cases", options.cases}, {"quick", options.quick}, {"results", std::move(stored)}});
}

Parts readParts(const std::vector<std::string>& folders, Diagnostics& diagnostics) {
  Parts parts;
  for (const cluster::ShardFile& shard : cluster::readShards(folders, "presa stability", diagnostics)) {
    try {
      parts.work = shard.head.work;
      parts.options.cases = shard.content.at("cases");
      parts.options.quick = shard.content.at("quick");
      for (const json& stored : shard.content.at("results")) parts.results.push_back(resultFrom(stored));
    } catch (const json::exception&) {
      cluster::tellDamaged(shard.head.folder, diagnostics);
    }
  }
  return parts;
}

}  // namespace presa::stability
