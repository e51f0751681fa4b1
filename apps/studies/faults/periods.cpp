#include "apps/studies/faults/periods.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "apps/common/atomic_file.h"
#include "apps/common/exit_status.h"
#include "apps/common/machine.h"
#include "apps/common/terminal/job_progress.h"
#include "apps/common/terminal_run.h"
#include "experiments/runner/statistics/means.h"
#include "experiments/runner/statistics/resampling.h"
#include "experiments/study/jobs.h"
#include "framework/core/diagnostics/refuse.h"
#include "framework/core/math/random.h"
#include "framework/session/realtime_rights.h"

namespace presa::device {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<double, 3> kPercentiles{0.5, 0.99, 0.999};
constexpr std::size_t kDraws = 4000;  // bootstrap resamples
constexpr double kLevel = 0.95;

/// Steal time so far, in clock ticks of /proc/stat: time that the host gave to other virtual machines.
std::int64_t stolen() {
  std::ifstream stat("/proc/stat");
  std::string word;
  std::int64_t value = 0;
  stat >> word;
  for (int column = 0; column < 8; ++column) stat >> value;
  return value;
}

Loaded load(const std::string& scene, double seconds) {
  RunOptions options;
  options.realtime = true;
  options.duration = seconds;
  Diagnostics diagnostics;
  Loaded loaded = loadWorld({scene, "", {}}, options, diagnostics);
  if (diagnostics.hasErrors()) throw InputError(diagnostics);
  return loaded;
}

/// Does one run and returns the percentiles of its haptic period [us] as JSON. Called in a process of its own.
std::string oneRun(const std::string& scene, double seconds) {
  TerminalRun run(load(scene, seconds), {.quiet = true, .command = "presa device periods"});
  const std::int64_t before = stolen();
  run.execute();
  Json result{{"scene", scene}, {"stolen", stolen() - before}};
  for (const RunResult::Rate& rate : run.result().rates) {
    if (rate.group != RateGroup::kHaptic) continue;
    for (const double p : kPercentiles)
      result["period_us"].push_back(1e-3 * static_cast<double>(rate.timing->period.percentile(p)));
  }
  return result.dump();
}

using Values = std::array<std::vector<double>, 2>;  // one vector per scene

/// Bootstrap interval of the ratio of medians, second scene over first.
std::optional<statistics::Interval> ratioInterval(const Values& values, RandomStream& random) {
  std::vector<double> ratios;
  Values drawn = values;
  for (std::size_t draw = 0; draw < kDraws; ++draw) {
    for (std::size_t s = 0; s < 2; ++s)
      for (double& value : drawn[s]) value = values[s][random.below(values[s].size())];
    ratios.push_back(*statistics::median(drawn[1]) / *statistics::median(drawn[0]));
  }
  return statistics::percentileInterval(ratios, kLevel);
}

Json compare(const std::vector<Json>& runs, const PeriodsOptions& options, bool undisturbed) {
  Json rows = Json::array();
  RandomStream random(options.seed, "bootstrap");
  std::printf("%s\n  percentile   runs      first    second   ratio   95 %% interval\n",
              undisturbed ? "runs in which no other machine took the processor" : "all runs");
  for (std::size_t p = 0; p < kPercentiles.size(); ++p) {
    Values values;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      if (!undisturbed || runs[i]["stolen"] == 0) values[i % 2].push_back(runs[i]["period_us"][p]);
    }
    const auto first = statistics::median(values[0]), second = statistics::median(values[1]);
    if (!first || !second) continue;
    const auto interval = ratioInterval(values, random);
    std::printf("  %10.1f %6zu %7.0f us %6.0f us %7.3f   %.3f to %.3f\n", 100 * kPercentiles[p],
                values[0].size() + values[1].size(), *first, *second, *second / *first, interval->low, interval->high);
    rows.push_back({{"percentile", 100 * kPercentiles[p]},
                    {"runs", {values[0].size(), values[1].size()}},
                    {"median_us", {*first, *second}},
                    {"ratio", *second / *first},
                    {"interval", {interval->low, interval->high}}});
  }
  return rows;
}

std::vector<Json> runInTurn(const PeriodsOptions& options) {
  const auto count = 2 * static_cast<std::size_t>(options.runs);
  terminal::JobProgress progress(count);
  JobOptions jobs;
  jobs.workers = 1;
  jobs.stop = [] { return terminal::JobProgress::interrupted(); };
  jobs.on_wait = [&] { progress.show(); };
  jobs.on_done = [&](std::size_t i, const JobResult&) { progress.done(options.scenes[i % 2]); };
  const auto results = runJobs(
      count, [&](std::size_t i) { return oneRun(options.scenes[i % 2], options.seconds); }, jobs);
  progress.finish();
  std::vector<Json> runs;
  for (const JobResult& result : results) {
    if (result.outcome == JobResult::Outcome::kNotRun) break;
    if (result.outcome != JobResult::Outcome::kDone) throw std::runtime_error("a run failed: " + result.text);
    runs.push_back(Json::parse(result.text));
  }
  return runs;
}

}  // namespace

int comparePeriods(const PeriodsOptions& options) {
  for (const std::string& scene : options.scenes) load(scene, options.seconds);  // a bad scene throws here
  if (const std::string refused = realtimeRights().fifo; !refused.empty())
    refuse(469, "presa device periods", "without SCHED_FIFO a period says nothing of the scene: " + refused,
           "as root, or with rtprio in limits.conf");
  if (!options.out.empty()) std::filesystem::create_directories(options.out);
  const std::vector<Json> runs = runInTurn(options);
  if (runs.size() < 2) return kExitInterrupted;
  std::printf("haptic period, %s and %s\n", options.scenes[0].c_str(), options.scenes[1].c_str());
  Json all = compare(runs, options, false), undisturbed = compare(runs, options, true);
  Json machine = Json::object();
  for (const auto& [what, value] : machineFacts()) machine[what] = value;
  if (!options.out.empty())
    writeFileAtomically(options.out + "/periods.json", Json{{"scenes", options.scenes},
                                                            {"seconds", options.seconds},
                                                            {"machine", machine},
                                                            {"all", all},
                                                            {"undisturbed", undisturbed},
                                                            {"runs", runs}}
                                                               .dump(2) +
                                                           "\n");
  return terminal::JobProgress::interrupted() ? kExitInterrupted : kExitOk;
}

}  // namespace presa::device
