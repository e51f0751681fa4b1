#include "apps/presa/experiment/dry_run.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/presa/terminal/text.h"

namespace presa::experiment {
namespace {

using terminal::format;

std::vector<const Column*> columnsOf(const Experiment& experiment) {
  std::vector<const Column*> all;
  for (const Factor& factor : experiment.factors) {
    for (const Column& column : factor.columns) all.push_back(&column);
  }
  return all;
}

std::string minutes(double seconds) {
  if (seconds < 90) return format("%.0f s", seconds);
  if (seconds < 5400) return format("%.0f min", seconds / 60);
  return format("%.1f h", seconds / 3600);
}

int restsOf(const Experiment& experiment, const std::vector<PlannedTrial>& trials) {
  const auto counted = std::count_if(trials.begin(), trials.end(), [](const auto& trial) { return !trial.practice; });
  return experiment.rest.every == 0 || counted == 0 ? 0 : static_cast<int>(counted - 1) / experiment.rest.every;
}

std::string headOf(const Experiment& experiment, const Subject& subject, int session,
                   const std::vector<PlannedTrial>& trials) {
  const Span trial = durationOf(experiment);
  const int rests = restsOf(experiment, trials);
  const double pause = rests * experiment.rest.seconds;
  const double n = static_cast<double>(trials.size());
  const auto practice = std::count_if(trials.begin(), trials.end(), [](const auto& t) { return t.practice; });
  const int blocks = trials.empty() ? 0 : trials.back().block;
  std::string text = experiment.title.empty() ? experiment.name : experiment.title;
  text += format("\nsubject %s (number %d), session %d, seed %llu\n", subject.id.c_str(), subject.number, session,
                 static_cast<unsigned long long>(experiment.seed));
  text += format("%zu conditions, %d times each: %zu trials after %zu for practice, in %d block%s; %d rest%s of %s\n",
                 conditionsOf(experiment, subject.number).size(), experiment.design.repeats,
                 trials.size() - static_cast<std::size_t>(practice), static_cast<std::size_t>(practice), blocks,
                 blocks == 1 ? "" : "s", rests, rests == 1 ? "" : "s", minutes(experiment.rest.seconds).c_str());
  text += "phases:";
  for (const Phase& phase : experiment.phases)
    text += format(" %s (%s%s)", phase.name.c_str(), phase.until ? "at most " : "", minutes(phase.seconds).c_str());
  text += format("\nduration: %s when every awaited thing happens at once, %s at most\n",
                 minutes(n * trial.least + pause).c_str(), minutes(n * trial.most + pause).c_str());
  return text;
}

}  // namespace

Span durationOf(const Experiment& experiment) {
  Span span;
  for (const Phase& phase : experiment.phases) {
    span.least += phase.until ? phase.hold : phase.seconds;
    span.most += phase.seconds;
  }
  return span;
}

std::string dryRunText(const Experiment& experiment, const Subject& subject, int session,
                       const std::vector<PlannedTrial>& trials) {
  const std::vector<const Column*> columns = columnsOf(experiment);
  std::string text = headOf(experiment, subject, session, trials) + "\ntrial  block  repeat";
  for (const Column* column : columns) text += format("  %14s", headingOf(column->name, column->unit).c_str());
  text += "  seed\n";
  for (const PlannedTrial& trial : trials) {
    text += trial.practice ? format("%4dp  %5s  %6s", trial.number, "-", "-")
                           : format("%5d  %5d  %6d", trial.number, trial.block, trial.repeat);
    for (const Column* column : columns)
      text += format("  %14s", experiment.valueOf(column->name, trial.condition).c_str());
    text += format("  %016llx\n", static_cast<unsigned long long>(trial.seed));
  }
  return text;
}

std::string dryRunCsv(const Experiment& experiment, const std::vector<PlannedTrial>& trials) {
  const std::vector<const Column*> columns = columnsOf(experiment);
  std::string text = "trial,practice,block,repeat";
  for (const Column* column : columns) text += ",\"" + headingOf(column->name, column->unit) + "\"";
  text += ",seed\n";
  for (const PlannedTrial& trial : trials) {
    text += format("%d,%d,%d,%d", trial.number, trial.practice ? 1 : 0, trial.block, trial.repeat);
    for (const Column* column : columns) text += "," + experiment.valueOf(column->name, trial.condition);
    text += format(",%llu\n", static_cast<unsigned long long>(trial.seed));
  }
  return text;
}

std::string dryRunJson(const Experiment& experiment, const Subject& subject, int session,
                       const std::vector<PlannedTrial>& trials) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const PlannedTrial& trial : trials) {
    nlohmann::ordered_json condition;
    for (const Column* column : columnsOf(experiment))
      condition[column->name] = experiment.valueOf(column->name, trial.condition);
    list.push_back({{"trial", trial.number},
                    {"practice", trial.practice},
                    {"block", trial.block},
                    {"repeat", trial.repeat},
                    {"condition", condition},
                    {"seed", std::to_string(trial.seed)}});  // 64 bits are more than a JSON number holds
  }
  const Span trial = durationOf(experiment);
  const double n = static_cast<double>(trials.size());
  const double pause = restsOf(experiment, trials) * experiment.rest.seconds;
  const nlohmann::ordered_json all{{"experiment", experiment.name},
                                   {"subject", subject.id},
                                   {"number", subject.number},
                                   {"session", session},
                                   {"seed", experiment.seed},
                                   {"seconds_least", n * trial.least + pause},
                                   {"seconds_most", n * trial.most + pause},
                                   {"trials", list}};
  return all.dump(2) + "\n";
}

}  // namespace presa::experiment
