#include "apps/studies/cost/run_store.h"

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "apps/common/atomic_file.h"
#include "apps/common/file_text.h"
#include "experiments/study/jobs.h"

namespace presa::cost {
namespace {

nlohmann::json readJson(const std::string& file) { return nlohmann::json::parse(contentsOf(file)); }

std::string timingName(const std::string& base, int repeat) {
  return base + ".time" + std::to_string(repeat) + ".json";
}

}  // namespace

std::string RunStore::base(std::uint64_t scene_hash) const {
  char name[40];
  std::snprintf(name, sizeof name, "/%016llx", static_cast<unsigned long long>(scene_hash * 31 + common_));
  return folder_ + name;
}

bool RunStore::hasEvidence(std::uint64_t scene_hash) const {
  const std::string name = base(scene_hash);
  if (!std::filesystem::exists(name + ".json")) return false;
  return std::filesystem::exists(name + ".trace") || !evidence(scene_hash, false).failure.empty();
}

bool RunStore::hasTiming(std::uint64_t scene_hash, int repeat) const {
  return std::filesystem::exists(timingName(base(scene_hash), repeat));
}

void RunStore::save(std::uint64_t scene_hash, const Evidence& evidence) const {
  const std::string name = base(scene_hash);
  if (evidence.failure.empty()) evidence.trace.save(name + ".trace");
  writeFileAtomically(name + ".json", toJson(evidence).dump());  // last: this file implies that the trace exists
}

void RunStore::save(std::uint64_t scene_hash, int repeat, const Timing& timing) const {
  writeFileAtomically(timingName(base(scene_hash), repeat), toJson(timing).dump());
}

Evidence RunStore::evidence(std::uint64_t scene_hash, bool with_trace) const {
  Evidence found = evidenceFrom(readJson(base(scene_hash) + ".json"));
  if (with_trace && found.failure.empty()) found.trace = Trace::load(base(scene_hash) + ".trace");
  return found;
}

Timing RunStore::timing(std::uint64_t scene_hash, int repeat) const {
  return timingFrom(readJson(timingName(base(scene_hash), repeat)));
}

void RunStore::dropTraces(int workers) const {
  std::vector<std::filesystem::path> traces;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    if (entry.path().extension() == ".trace") traces.push_back(entry.path());
  }
  const auto jobs = static_cast<std::size_t>(workers);
  const auto remove = [&](std::size_t job) {
    for (std::size_t i = job; i < traces.size(); i += jobs) std::filesystem::remove(traces[i]);
    return std::string();
  };
  for (const JobResult& result : runJobs(jobs, remove, {.workers = workers}))
    if (result.outcome != JobResult::Outcome::kDone) throw std::runtime_error("cannot remove a trace: " + result.text);
}

}  // namespace presa::cost
