#include "apps/temple/trials/results.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "apps/common/atomic_file.h"
#include "apps/common/cluster/shard_file.h"
#include "apps/common/delimited.h"
#include "apps/common/exit_status.h"
#include "apps/common/report/page.h"
#include "apps/common/report/svg_facets.h"
#include "apps/common/report/svg_plot.h"
#include "apps/common/terminal/text.h"
#include "apps/common/wilson.h"
#include "framework/core/diagnostics/refuse.h"

namespace presa::temple {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using terminal::format;

/// Of whole buildings, by rising time.
std::vector<double> timesOf(const std::vector<Trial>& trials) {
  std::vector<double> times;
  for (const Trial& trial : trials)
    if (trial.whole()) times.push_back(trial.simulated);
  std::ranges::sort(times);
  return times;
}

std::string commandOf(const TrialsPlan& plan, const Trial& trial) {
  std::string command = "presa";
  for (const std::string& word : wordsOf(plan, trial.seed)) command += " " + word;
  return command;
}

std::string whatHappened(const Trial& trial) {
  if (!trial.reason.empty()) return trial.reason;
  return format("%d of %d blocks placed, %d dropped, %d lost", trial.placed, trial.pieces, trial.drops, trial.lost) +
         (trial.faults == 0 ? "" : ", a fault of the dynamics");
}

/// "18 of 20 buildings whole: 90 % (95 % interval 70 to 97 %)"
std::string verdictOf(const std::vector<Trial>& trials) {
  const std::vector<double> times = timesOf(trials);
  const Share share = shareOf(times.size(), trials.size());
  std::string text = format("%zu of %zu buildings whole: %.0f %% (95 %% interval %.0f to %.0f %%)", times.size(),
                            trials.size(), 100 * share.value, 100 * share.low, 100 * share.high);
  if (!times.empty())
    text += format(", in a median of %.0f s", 0.5 * (times[(times.size() - 1) / 2] + times[times.size() / 2]));
  return text;
}

std::string csvOf(const std::vector<Trial>& trials) {
  std::string text =
      "seed,whole,pieces,placed,drops,lost,faults,worst_position_error_m,worst_angle_error_deg,simulated_s,wall_s,"
      "reason\n";
  for (const Trial& trial : trials)
    text += format("%llu,%d,%d,%d,%d,%d,%u,%.9g,%.9g,%.9g,%.9g,", static_cast<unsigned long long>(trial.seed),
                   trial.whole() ? 1 : 0, trial.pieces, trial.placed, trial.drops, trial.lost, trial.faults,
                   trial.position_error, trial.angle_error, trial.simulated, trial.wall) +
            quotedCell(trial.reason, ',') + "\n";
  return text;
}

/// Share of whole buildings over time.
std::string figureOf(const std::vector<Trial>& trials) {
  svg::FacetFigure figure;
  figure.title = "Share of whole buildings over time";
  figure.x_label = "simulated time [s]";
  figure.y_label = "share of whole buildings";
  figure.y_max = 1;
  figure.x_from_zero = true;
  svg::Layer line{svg::Layer::Kind::kLine, 0, false, {{0, 0}}};
  const std::vector<double> times = timesOf(trials);
  double share = 0;
  for (const double time : times) {
    line.points.push_back({time, share});
    share += 1 / static_cast<double>(trials.size());
    line.points.push_back({time, share});
  }
  figure.facets.push_back({{line}});
  return "<figure><h2>When buildings were whole</h2>\n" + svg::render(figure) + "</figure>\n";
}

std::string pageOf(const TrialsPlan& plan, const std::vector<Trial>& trials) {
  const std::size_t whole = timesOf(trials).size();
  std::string text = page::head("Trials of the temple – Presa") + "<h1>The temple, rebuilt by simulated hands</h1>\n" +
                     "<p class=\"lead\">" + svg::escape(plan.size + ", after " + plan.plan) +
                     ": ruins of consecutive seeds, each rebuilt by friction alone.</p>\n<div class=\"verdict " +
                     (whole == trials.size() ? "good" : "bad") + "\"><b>" + svg::escape(verdictOf(trials)) +
                     "</b></div>\n" + (whole > 0 ? figureOf(trials) : std::string());
  if (whole < trials.size()) {
    text += "<h2>Not whole</h2>\n<table><tr><th>seed</th><th>what happened</th><th>see it again</th></tr>\n";
    for (const Trial& trial : trials)
      if (!trial.whole())
        text += "<tr><td>" + std::to_string(trial.seed) + "</td><td>" + svg::escape(whatHappened(trial)) +
                "</td><td><code>" + svg::escape(commandOf(plan, trial)) + "</code></td></tr>\n";
    text += "</table>\n";
  }
  return text + page::tail();
}

json toJson(const Trial& trial) {
  return {trial.seed,   trial.reason,         trial.pieces,      trial.placed,    trial.drops, trial.lost,
          trial.faults, trial.position_error, trial.angle_error, trial.simulated, trial.wall};
}

Trial trialFrom(const json& stored) {
  return {stored.at(0), stored.at(1), stored.at(2), stored.at(3), stored.at(4), stored.at(5),
          stored.at(6), stored.at(7), stored.at(8), stored.at(9), stored.at(10)};
}

json toJson(const TrialsPlan& plan) {
  return {
      {"size", plan.size}, {"plan", plan.plan}, {"seeds", plan.seeds}, {"first", plan.first_seed}, {"for", plan.limit}};
}

TrialsPlan planFrom(const json& stored) {
  TrialsPlan plan;
  plan.size = stored.at("size");
  plan.plan = stored.at("plan");
  plan.seeds = stored.at("seeds");
  plan.first_seed = stored.at("first");
  plan.limit = stored.at("for");
  return plan;
}

}  // namespace

int reportTrials(const TrialsPlan& plan, const std::vector<Trial>& trials) {
  writeFileAtomically(plan.out + "/trials.csv", csvOf(trials));
  writeFileAtomically(plan.out + "/trials.html", pageOf(plan, trials));
  std::printf("%s\n", verdictOf(trials).c_str());
  for (const Trial& trial : trials)
    if (!trial.whole())
      std::printf("  seed %llu: %s: %s\n", static_cast<unsigned long long>(trial.seed), whatHappened(trial).c_str(),
                  commandOf(plan, trial).c_str());
  std::printf("%s/trials.html, trials.csv\n", plan.out.c_str());
  return std::ranges::all_of(trials, &Trial::whole) ? kExitOk : kExitFault;
}

void keepShard(const TrialsPlan& plan, const std::vector<Trial>& trials) {
  json stored = json::array();
  for (const Trial& trial : trials) stored.push_back(toJson(trial));
  cluster::writeShardFile(plan.out, *plan.shard, toJson(plan).dump(),
                          {{"plan", toJson(plan)}, {"trials", std::move(stored)}});
  std::printf("Shard %s: %zu of %d seeds. When all shards are there: presa temple trials merge FOLDER… --out FOLDER\n",
              cluster::textOf(*plan.shard).c_str(), trials.size(), plan.seeds);
}

int mergeTrials(const std::vector<std::string>& folders, const std::string& out) {
  Diagnostics diagnostics;
  TrialsPlan plan;
  std::vector<Trial> trials;
  for (const cluster::ShardFile& shard : cluster::readShards(folders, "presa temple trials", diagnostics)) {
    try {
      plan = planFrom(shard.content.at("plan"));
      for (const json& stored : shard.content.at("trials")) trials.push_back(trialFrom(stored));
    } catch (const json::exception&) {
      cluster::tellDamaged(shard.head.folder, diagnostics);
    }
  }
  if (diagnostics.hasErrors()) throw InputError(std::move(diagnostics));
  std::ranges::sort(trials, {}, &Trial::seed);
  plan.out = out;
  makeFolder(out);
  return reportTrials(plan, trials);
}

int submitTrials(const TrialsPlan& plan, const cluster::SubmitOptions& on) {
  constexpr const char* kCommand = "presa temple trials submit";
  Diagnostics diagnostics;
  cluster::checkCluster(kCommand, on, diagnostics);
  if (diagnostics.hasErrors()) throw InputError(std::move(diagnostics));
  makeFolder(plan.out);
  std::vector<std::string> words{"temple",       "trials",
                                 "--size",       plan.size,
                                 "--plan",       plan.plan,
                                 "--seeds",      std::to_string(plan.seeds),
                                 "--first-seed", std::to_string(plan.first_seed)};
  if (plan.limit > 0) words.insert(words.end(), {"--for", format("%.17g", plan.limit)});
  const cluster::ShardedWork work{
      .command = kCommand,
      .name = "presa_temple_" + plan.size,
      .folder = fs::absolute(plan.out).string() + "/shards",
      .words = std::move(words),
      .is_done = [wanted = toJson(plan).dump()](const std::string& folder, const cluster::Shard& shard) {
        return cluster::holdsShard(folder, shard, wanted);
      }};
  if (const auto status = cluster::submitShards(work, on)) return *status;
  return mergeTrials(cluster::shardFolders(work, on), plan.out);
}

}  // namespace presa::temple
