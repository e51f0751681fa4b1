#include "apps/studies/stability/runner.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>

#include "apps/common/atomic_file.h"
#include "apps/common/cluster/shard_file.h"
#include "apps/common/exit_status.h"
#include "apps/common/terminal/job_progress.h"
#include "apps/studies/stability/parts.h"
#include "apps/studies/stability/report.h"
#include "apps/studies/stability/rows.h"
#include "apps/studies/stability/table.h"
#include "experiments/study/jobs.h"
#include "framework/core/diagnostics/refuse.h"

namespace presa::stability {
namespace {

enum RunnerCode { kOtherCases = 811 };

constexpr double kTrialLimit = 300;  // [s]

std::vector<Case> chosenCases(const RunnerOptions& options, std::vector<Case> all) {
  std::vector<std::string> names;
  for (const Case& c : all) names.push_back(c.name);
  Diagnostics diagnostics;
  for (const std::string& wanted : options.cases) {
    if (std::find(names.begin(), names.end(), wanted) != names.end()) continue;
    diagnostics.error(616, {"--case " + wanted, 0, 0}, "there is no case " + quote(wanted) + didYouMean(wanted, names),
                      "presa stability --list names them");
  }
  if (!options.out.empty()) {
    std::error_code failed;
    std::filesystem::create_directories(options.out, failed);
    if (failed || !std::ofstream(options.out + "/rows.jsonl", std::ios::app)) {
      diagnostics.error(612, {"--out " + options.out, 0, 0}, "nothing can be written there",
                        failed ? failed.message() : "the folder is not writable");
    }
  }
  if (diagnostics.hasErrors()) throw InputError(diagnostics);
  if (options.cases.empty()) return all;
  std::erase_if(all, [&](const Case& c) {
    return std::find(options.cases.begin(), options.cases.end(), c.name) == options.cases.end();
  });
  return all;
}

struct Job {
  const Case* of = nullptr;
  const Trial* trial = nullptr;
};

std::vector<Job> jobsOf(const std::vector<Case>& cases, bool quick) {
  std::vector<Job> jobs;
  for (const Case& c : cases) {
    for (const Trial& trial : c.trials) {
      if (!quick || trial.quick) jobs.push_back({&c, &trial});
    }
  }
  return jobs;
}

/// The finding of a trial that did not end.
Finding failure() {
  Finding finding;
  finding.metric = "trial ends";
  finding.verdict = Verdict::kFailed;
  finding.oracle = "every trial ends with findings";
  finding.value = std::numeric_limits<double>::quiet_NaN();
  return finding;
}

std::string reasonOf(const JobResult& result) {
  switch (result.outcome) {
    case JobResult::Outcome::kTimedOut:
      return "no end after " + std::to_string(static_cast<int>(kTrialLimit)) + " s";
    case JobResult::Outcome::kCrashed:
      return "crashed: " + result.text;
    default:
      return result.text;
  }
}

std::vector<Row> rowsOf(const std::vector<Job>& jobs, const std::vector<JobResult>& results) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const JobResult& result = results[i];
    if (result.outcome == JobResult::Outcome::kNotRun) continue;
    const bool done = result.outcome == JobResult::Outcome::kDone;
    for (Finding& finding : done ? unpackFindings(result.text) : std::vector{failure()}) {
      rows.push_back({jobs[i].of->name, jobs[i].trial->parameters, jobs[i].trial->method, std::move(finding),
                      jobs[i].trial->expected, jobs[i].of->source, result.seconds, done ? "" : reasonOf(result)});
    }
  }
  return rows;
}

void list(const std::vector<Case>& cases) {
  for (const Case& c : cases) {
    std::printf("%s  (%zu trials)\n  %s\n  held against: %s\n  source: %s\n  see it: presa run %s\n\n", c.name.c_str(),
                c.trials.size(), c.title.c_str(), c.oracle.c_str(), c.source.c_str(), sceneFile(c.scene).c_str());
  }
}

std::string asLines(const std::vector<Row>& rows) {
  std::string lines;
  for (const Row& row : rows) lines += toJson(row).dump() + "\n";
  return lines;
}

/// Name of each trial, for shards to compare.
std::vector<std::string> namesOf(const std::vector<Job>& jobs) {
  std::vector<std::string> names;
  for (const Job& job : jobs) {
    std::string name = job.of->name + " " + job.trial->method;
    for (const auto& [parameter, value] : job.trial->parameters) name += " " + parameter + "=" + value;
    names.push_back(std::move(name));
  }
  return names;
}

/// Runs the trials of the shard, or all; the others are kNotRun.
Results runTrials(const std::vector<Job>& jobs, const RunnerOptions& options, bool& interrupted) {
  std::vector<std::size_t> own;
  for (std::size_t i = 0; i < jobs.size(); ++i)
    if (!options.shard || options.shard->holds(i)) own.push_back(i);
  terminal::JobProgress progress(own.size());
  JobOptions job_options;
  job_options.workers = options.jobs;
  job_options.time_limit = kTrialLimit;
  job_options.stop = [&] { return progress.interrupted(); };
  job_options.on_wait = [&] { progress.show(); };
  job_options.on_done = [&](std::size_t i, const JobResult&) { progress.done(jobs[own[i]].of->name); };
  const auto ran = runJobs(
      own.size(), [&](std::size_t i) { return packFindings(jobs[own[i]].trial->run()); }, job_options);
  progress.finish();
  interrupted = progress.interrupted();
  Results results(jobs.size());
  for (std::size_t i = 0; i < own.size(); ++i) results[own[i]] = ran[i];
  return results;
}

/// Writes and prints the rows; returns the exit status.
int tell(const RunnerOptions& options, const std::vector<Case>& cases, const std::vector<Row>& rows) {
  if (!options.out.empty()) {
    writeFileAtomically(options.out + "/rows.jsonl", asLines(rows));
    writeFileAtomically(options.out + "/report.html", reportHtml(cases, rows));
  }
  std::fputs(options.format == "json" ? asLines(rows).c_str() : tableText(cases, rows, options.out).c_str(), stdout);
  return std::any_of(rows.begin(), rows.end(), [](const Row& row) { return row.worse(); }) ? kExitFault : kExitOk;
}

}  // namespace

int runCases(const RunnerOptions& options, std::vector<Case> all) {
  const std::vector<Case> cases = chosenCases(options, std::move(all));
  if (options.list) {
    list(cases);
    return kExitOk;
  }
  for (const Case& c : cases) sceneFile(c.scene);  // E615 says now what would fail every trial
  const std::vector<Job> jobs = jobsOf(cases, options.quick);
  bool interrupted = false;
  const Results results = runTrials(jobs, options, interrupted);
  if (options.shard) {
    if (interrupted) return kExitInterrupted;
    writePart(options, namesOf(jobs), results);
    std::printf("Shard %s. When all shards are there: presa stability merge FOLDER…\n%s\n",
                cluster::textOf(*options.shard).c_str(), options.out.c_str());
    return kExitOk;
  }
  const int status = tell(options, cases, rowsOf(jobs, results));
  return interrupted ? kExitInterrupted : status;
}

int submitCases(const RunnerOptions& options, const cluster::SubmitOptions& on) {
  constexpr const char* kCommand = "presa stability submit";
  Diagnostics diagnostics;
  cluster::checkCluster(kCommand, on, diagnostics);
  if (diagnostics.hasErrors()) throw InputError(std::move(diagnostics));
  const std::vector<Case> cases = chosenCases(options, allCases());
  std::vector<std::string> words{"stability"};
  for (const std::string& name : options.cases) words.insert(words.end(), {"--case", name});
  if (options.quick) words.emplace_back("--quick");
  const cluster::ShardedWork work{.command = kCommand,
                                  .name = "presa_stability",
                                  .folder = std::filesystem::absolute(options.out).string() + "/shards",
                                  .words = std::move(words),
                                  .is_done = [trials = workOf(namesOf(jobsOf(cases, options.quick)))](
                                                 const std::string& folder, const cluster::Shard& shard) {
                                    return cluster::holdsShard(folder, shard, trials);
                                  }};
  if (const auto status = cluster::submitShards(work, on)) return *status;
  return mergeCases(cluster::shardFolders(work, on), options);
}

int mergeCases(const std::vector<std::string>& folders, const RunnerOptions& options, std::vector<Case> all) {
  Diagnostics diagnostics;
  Parts parts = readParts(folders, diagnostics);
  if (diagnostics.hasErrors()) throw InputError(std::move(diagnostics));
  parts.options.out = options.out;
  parts.options.format = options.format;
  const std::vector<Case> cases = chosenCases(parts.options, std::move(all));
  const std::vector<Job> jobs = jobsOf(cases, parts.options.quick);
  if (workOf(namesOf(jobs)) != parts.work)
    refuse(kOtherCases, folders.front(), "was made with other cases than this release has", "make the shards again");
  Results results(jobs.size());
  for (auto& [trial, result] : parts.results) results.at(trial) = std::move(result);
  return tell(parts.options, cases, rowsOf(jobs, results));
}

}  // namespace presa::stability
