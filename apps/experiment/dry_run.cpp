#include "apps/experiment/dry_run.h"

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>

#include "apps/common/terminal/text.h"
#include "experiments/runner/definition/presentation.h"
#include "experiments/runner/definition/trial_source.h"
#include "framework/core/math/random.h"

namespace presa::experiment {
namespace {

using terminal::format;

/// A column of the dry run: a property of a trial beside its place in the order.
struct DryColumn {
  std::string name, unit;
  std::string heading() const { return headingOf(name, unit); }
  std::function<std::string(const PlannedTrial&)> value;
};

std::vector<DryColumn> columnsOf(const Experiment& experiment) {
  std::vector<DryColumn> all;
  for (const Factor& factor : experiment.factors) {
    for (const Column& column : factor.columns)
      all.push_back({column.name, column.unit, [&experiment, name = column.name](const PlannedTrial& trial) {
                       return experiment.valueOf(name, trial.condition);
                     }});
  }
  for (std::size_t v = 0; v < experiment.varied.size(); ++v) {
    const Column& column = experiment.varied[v].column;
    all.push_back({column.name, column.unit, [&experiment, v](const PlannedTrial& trial) {
                     return format("%.4g", variedOf(experiment, trial)[v]);
                   }});
  }
  if (!experiment.procedure) return all;
  const StimulusAxis& stimulus = experiment.procedure->stimulus;
  all.push_back({stimulus.column.name, stimulus.column.unit, [&stimulus](const PlannedTrial& trial) {
                   return format("%.4g", stimulus.axis.valueAt(trial.stimulus->level));
                 }});
  all.push_back({"standard_place", "", [](const PlannedTrial& trial) {
                   return trial.stimulus->standard_place == 0 ? "-" : std::to_string(trial.stimulus->standard_place);
                 }});
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
  if (!experiment.model.empty()) text += experiment.model + "\n";
  const std::size_t counted = trials.size() - static_cast<std::size_t>(practice);
  if (experiment.procedure)
    text += format("the method chooses: %zu trials here, %zu at most, after %zu for practice, in %d block%s; ", counted,
                   maxTrials(*experiment.procedure) * static_cast<std::size_t>(blocks),
                   static_cast<std::size_t>(practice), blocks, blocks == 1 ? "" : "s");
  else
    text += format("%zu conditions, %d times each: %zu trials after %zu for practice, in %d block%s; ",
                   conditionsOf(experiment, subject.number).size(), experiment.design.repeats, counted,
                   static_cast<std::size_t>(practice), blocks, blocks == 1 ? "" : "s");
  text += format("%d rest%s of %s\n", rests, rests == 1 ? "" : "s", minutes(experiment.rest.seconds).c_str());
  if (experiment.procedure)
    text += "listed for a subject who is right three times in four; answers change the trials that follow\n";
  text += "phases:";
  for (const Phase& phase : experiment.phases)
    text += format(" %s (%s%s)", phase.name.c_str(), phase.until ? "at most " : "", minutes(phase.seconds).c_str());
  text += format("\nduration: %s when every awaited event happens at once, %s at most\n",
                 minutes(n * trial.min + pause).c_str(), minutes(n * trial.max + pause).c_str());
  return text;
}

}  // namespace

Span durationOf(const Experiment& experiment) {
  Span span;
  for (const Phase& phase : experiment.phases) {
    span.min += phase.until ? phase.hold : phase.seconds;
    span.max += phase.seconds;
  }
  const double times = experiment.procedure ? static_cast<double>(experiment.procedure->presentations()) : 1;
  span.min *= experiment.procedure && experiment.procedure->task == Task::kAdjust ? 2 : times;
  span.max *= times;
  return span;
}

std::vector<PlannedTrial> previewTrials(const Experiment& experiment, int subject_number, int session) {
  const auto source = makeTrialSource(experiment, subject_number, session);
  RandomStream answers(experiment.seed, "dry run", static_cast<std::uint64_t>(subject_number));
  std::vector<PlannedTrial> trials;
  while (const PlannedTrial* next = source->next()) {
    trials.push_back(*next);
    std::optional<psychophysics::Response> answer;
    if (const auto* method = source->method()) answer = method->responseFor(answers.uniform() < 0.75);
    source->finish(Outcome::kDone, answer);
  }
  return trials;
}

std::string dryRunText(const Experiment& experiment, const Subject& subject, int session,
                       const std::vector<PlannedTrial>& trials) {
  const std::vector<DryColumn> columns = columnsOf(experiment);
  std::string text = headOf(experiment, subject, session, trials) + "\ntrial  block  repeat";
  for (const DryColumn& column : columns) text += format("  %14s", column.heading().c_str());
  text += "  seed\n";
  for (const PlannedTrial& trial : trials) {
    text += trial.practice ? format("%4dp  %5s  %6s", trial.number, "-", "-")
                           : format("%5d  %5d  %6d", trial.number, trial.block, trial.repeat);
    for (const DryColumn& column : columns) text += format("  %14s", column.value(trial).c_str());
    text += format("  %016llx\n", static_cast<unsigned long long>(trial.seed));
  }
  return text;
}

std::string dryRunCsv(const Experiment& experiment, const std::vector<PlannedTrial>& trials) {
  const std::vector<DryColumn> columns = columnsOf(experiment);
  std::string text = "trial,practice,block,repeat";
  for (const DryColumn& column : columns) text += ",\"" + column.heading() + "\"";
  text += ",seed\n";
  for (const PlannedTrial& trial : trials) {
    text += format("%d,%d,%d,%d", trial.number, trial.practice ? 1 : 0, trial.block, trial.repeat);
    for (const DryColumn& column : columns) text += "," + column.value(trial);
    text += format(",%llu\n", static_cast<unsigned long long>(trial.seed));
  }
  return text;
}

std::string dryRunJson(const Experiment& experiment, const Subject& subject, int session,
                       const std::vector<PlannedTrial>& trials) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const PlannedTrial& trial : trials) {
    nlohmann::ordered_json condition;
    for (const DryColumn& column : columnsOf(experiment)) condition[column.name] = column.value(trial);
    list.push_back({{"trial", trial.number},
                    {"practice", trial.practice},
                    {"block", trial.block},
                    {"repeat", trial.repeat},
                    {"condition", condition},
                    {"seed", std::to_string(trial.seed)}});  // as text: a JSON number cannot hold 64 bits
  }
  const Span trial = durationOf(experiment);
  const double n = static_cast<double>(trials.size());
  const double pause = restsOf(experiment, trials) * experiment.rest.seconds;
  const nlohmann::ordered_json all{{"experiment", experiment.name},
                                   {"subject", subject.id},
                                   {"number", subject.number},
                                   {"session", session},
                                   {"model", experiment.model},
                                   {"seed", experiment.seed},
                                   {"seconds_least", n * trial.min + pause},
                                   {"seconds_most", n * trial.max + pause},
                                   {"trials", list}};
  return all.dump(2) + "\n";
}

}  // namespace presa::experiment
