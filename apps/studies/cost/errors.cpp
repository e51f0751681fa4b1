#include "apps/studies/cost/errors.h"

#include <malloc.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "apps/common/terminal/job_progress.h"
#include "experiments/study/jobs.h"

namespace presa::cost {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kRunsOfAJob = 32;  // few forks, and little to do after the first unresolved error

Compared compareRun(const RunStore& store, std::uint64_t scene_hash, const std::vector<const Metric*>& metrics,
                    const Evidence& reference) {
  const Evidence evidence = store.evidence(scene_hash, true);
  Compared compared{evidence.failure, {}};
  if (!compared.failure.empty()) return compared;
  for (const Metric* metric : metrics) compared.errors.push_back(metric->error(evidence, reference));
  return compared;
}

// CBOR keeps every bit of a number
std::string pack(const std::vector<Compared>& all) {
  Json packed = Json::array();
  for (const Compared& one : all) {
    Json errors = Json::array();
    for (const Value& error : one.errors) errors.push_back(error ? Json(*error) : Json());
    packed.push_back({one.failure, errors});
  }
  std::string bytes;
  Json::to_cbor(packed, bytes);
  return bytes;
}

std::vector<Compared> unpack(const std::string& bytes) {
  std::vector<Compared> all;
  for (const Json& one : Json::from_cbor(bytes)) {
    all.push_back({one.at(0), {}});
    for (const Json& error : one.at(1)) all.back().errors.push_back(error.is_null() ? Value() : Value(error));
  }
  return all;
}

}  // namespace

void keepFreeMemory() {
  for (const int kept : {M_MMAP_THRESHOLD, M_TRIM_THRESHOLD}) ::mallopt(kept, 1 << 30);
}

bool compareRuns(const RunStore& store, const std::vector<std::uint64_t>& scene_hashes,
                 const std::vector<const Metric*>& metrics, const Evidence& reference, int workers,
                 const std::function<bool(std::size_t run, const Compared& compared)>& take) {
  const auto end = [&](std::size_t job) { return std::min((job + 1) * kRunsOfAJob, scene_hashes.size()); };
  bool goes_on = true;
  std::string trouble;
  JobOptions options;
  options.workers = workers;
  options.stop = [&] { return !goes_on || !trouble.empty() || terminal::JobProgress::interrupted(); };
  options.on_done = [&](std::size_t job, const JobResult& result) {
    if (result.outcome != JobResult::Outcome::kDone) {
      trouble = "runs cannot be compared: " + result.text;
      return;
    }
    const std::vector<Compared> all = unpack(result.text);
    for (std::size_t i = 0; i < all.size() && goes_on; ++i) goes_on = take(job * kRunsOfAJob + i, all[i]);
  };
  const auto compare = [&](std::size_t job) {
    keepFreeMemory();
    std::vector<Compared> all;
    for (std::size_t i = job * kRunsOfAJob; i < end(job); ++i)
      all.push_back(compareRun(store, scene_hashes[i], metrics, reference));
    return pack(all);
  };
  runJobs((scene_hashes.size() + kRunsOfAJob - 1) / kRunsOfAJob, compare, options);
  if (!trouble.empty()) throw std::runtime_error(trouble);
  return goes_on && !terminal::JobProgress::interrupted();
}

}  // namespace presa::cost
