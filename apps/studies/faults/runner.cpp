#include "apps/studies/faults/runner.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "apps/common/atomic_file.h"
#include "apps/common/exit_status.h"
#include "apps/common/terminal/job_progress.h"
#include "experiments/study/experiment_file.h"
#include "experiments/study/jobs.h"
#include "framework/core/diagnostics/refuse.h"
#include "framework/session/realtime_rights.h"

namespace presa::faults {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kBlock = 50;  // runs per process

/// Does a block of runs of one fault; returns the worst figures as JSON, for the pipe to the parent process.
std::string runBlock(const Fault& fault, std::uint64_t seed, int first, int count) {
  Json block{{"runs", 0},
             {"broken", 0},
             {"reason", ""},
             {"detection", -1.0},
             {"zero", 0.0},
             {"step", 0.0},
             {"beyond", -1.0},
             {"delayed", Json::array()},
             {"not_started", Json::array()}};
  const auto keepMax = [&](const char* name, double value) {
    block[name] = std::max(block[name].get<double>(), value);
  };
  for (int i = first; i < first + count; ++i) {
    RandomStream random(seed, fault.name, static_cast<std::uint64_t>(i));
    const Outcome outcome = fault.run(random);
    block["runs"] = block["runs"].get<int>() + 1;
    if (!outcome.delayed.empty()) block["delayed"].push_back("run " + std::to_string(i) + ": " + outcome.delayed);
    for (const std::string& why : outcome.not_started) block["not_started"].push_back(why);
    keepMax("detection", outcome.detection);
    keepMax("zero", outcome.zero);
    keepMax("step", outcome.step);
    keepMax("beyond", outcome.energy - outcome.energy_allowed);
    const std::string reason = brokenBy(fault, outcome);
    if (reason.empty()) continue;
    if (block["broken"] == 0) block["reason"] = reason + " (run " + std::to_string(i) + ")";
    block["broken"] = block["broken"].get<int>() + 1;
  }
  return block.dump();
}

void add(const JobResult& result, int count, Row& row) {
  if (result.outcome != JobResult::Outcome::kDone) {
    if (result.outcome == JobResult::Outcome::kCrashed) row.watched = false;  // the transport watch crashes the run
    row.runs += count;
    row.broken += count;
    if (row.reason.empty()) row.reason = result.text.empty() ? "did not end" : result.text;
    return;
  }
  const Json block = Json::parse(result.text);
  row.runs += block["runs"].get<int>();
  row.broken += block["broken"].get<int>();
  if (row.reason.empty()) row.reason = block["reason"];
  for (const Json& one : block["delayed"]) row.delayed.push_back(one);
  for (const Json& why : block["not_started"]) row.not_started.push_back(why);
  row.worst.detection = std::max(row.worst.detection, block["detection"].get<double>());
  row.worst.zero = std::max(row.worst.zero, block["zero"].get<double>());
  row.worst.step = std::max(row.worst.step, block["step"].get<double>());
  row.energy_beyond = std::max(row.energy_beyond, block["beyond"].get<double>());
}

struct Block {
  std::size_t fault;
  int first, count;
};

std::vector<Block> blocksOf(const std::vector<Fault>& faults, int runs) {
  std::vector<Block> blocks;
  for (std::size_t f = 0; f < faults.size(); ++f) {
    const int wanted = std::min(runs, faults[f].max_runs);
    for (int first = 0; first < wanted; first += kBlock) blocks.push_back({f, first, std::min(kBlock, wanted - first)});
  }
  return blocks;
}

std::vector<Fault> chosen(const RunnerOptions& options) {
  std::vector<Fault> faults = allFaults();
  std::erase_if(faults, [&](const Fault& fault) { return fault.name.find(options.only) == std::string::npos; });
  if (faults.empty()) refuse(613, "--only " + options.only, "no fault has that in its name");
  if (const std::string refused = realtimeRights().fifo; !refused.empty()) {
    std::erase_if(faults, [&](const Fault& fault) {
      if (fault.real_time)
        std::fprintf(stderr, "left out: '%s' runs against the clock, and SCHED_FIFO is refused here (%s)\n",
                     fault.name.c_str(), refused.c_str());
      return fault.real_time;
    });
  }
  if (options.out.empty()) return faults;
  std::error_code failed;
  std::filesystem::create_directories(options.out, failed);
  if (failed) refuse(614, "--out " + options.out, "nothing can be written there", failed.message());
  return faults;
}

}  // namespace

int runFaults(const RunnerOptions& options) {
  experimentFile("faults/hold.xml");  // throws here if the file is missing, rather than in every run
  const std::vector<Fault> faults = chosen(options);
  const std::vector<Block> blocks = blocksOf(faults, options.runs);
  ::setenv("PRESA_WATCH_TRANSPORT", "1", 1);  // inherited by all runs and by the supervisors that they start
  terminal::JobProgress progress(blocks.size());
  JobOptions job_options;
  job_options.workers = options.jobs;
  job_options.stop = [&] { return progress.interrupted(); };
  job_options.on_wait = [&] { progress.show(); };
  job_options.on_done = [&](std::size_t i, const JobResult&) { progress.done(faults[blocks[i].fault].name); };
  const auto results = runJobs(
      blocks.size(),
      [&](std::size_t i) { return runBlock(faults[blocks[i].fault], options.seed, blocks[i].first, blocks[i].count); },
      job_options);
  progress.finish();

  std::vector<Row> rows;
  for (const Fault& fault : faults) {
    rows.emplace_back().fault = fault;
    rows.back().worst.detection = rows.back().energy_beyond = -1;
  }
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (results[i].outcome != JobResult::Outcome::kNotRun) add(results[i], blocks[i].count, rows[blocks[i].fault]);
  }
  if (!options.out.empty()) {
    writeFileAtomically(options.out + "/faults.json", toJson(rows).dump(2) + "\n");
    writeFileAtomically(options.out + "/faults.html", pageHtml(rows, options));
  }
  std::fputs(tableText(rows).c_str(), stdout);
  if (!options.out.empty()) std::printf("%s/faults.html\n", options.out.c_str());
  if (progress.interrupted()) return kExitInterrupted;
  return std::any_of(rows.begin(), rows.end(), [](const Row& row) { return row.broken > 0; }) ? kExitFault : kExitOk;
}

}  // namespace presa::faults
