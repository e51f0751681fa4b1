#include "apps/experiment/session_records.h"

#include <cmath>

#include "apps/common/machine.h"
#include "experiments/runner/definition/row.h"

namespace presa::experiment {
namespace {

Json conditionOf(const Experiment& experiment, const PlannedTrial& trial) {
  Json condition = Json::object();
  for (const Factor& factor : experiment.factors) {
    for (const Column& column : factor.columns)
      condition[column.name] = experiment.valueOf(column.name, trial.condition);
  }
  return condition;
}

Json numberOrNull(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

std::size_t presentationsPerTrial(const Experiment& experiment) {
  return experiment.procedure ? experiment.procedure->presentations() : 1;
}

Json phasesOf(const Experiment& experiment, const TrialResult& result) {
  Json phases = Json::object();
  for (std::size_t p = 0; p < result.phases.size(); ++p) {
    const Trial::Stretch& stretch = result.phases[p];
    phases[experiment.phases[p].name] = {numberOrNull(stretch.begin < 0 ? NAN : stretch.begin),
                                         numberOrNull(stretch.end < 0 ? NAN : stretch.end)};
  }
  return phases;
}

}  // namespace

Json factsJson(const std::vector<DeviceFact>& facts) {
  Json all = Json::object();
  for (const DeviceFact& fact : facts) all[fact.name] = {{"value", fact.value}, {"unit", fact.unit}};
  return all;
}

Json stimulusJson(const psychophysics::Stimulus& stimulus) {
  return {{"level", stimulus.level},
          {"track", stimulus.track},
          {"standard_place", stimulus.standard_place},
          {"catch_trial", stimulus.kind == psychophysics::TrialKind::kCatch}};
}

Json trialBegin(const Experiment& experiment, const PlannedTrial& trial, int run, bool recording) {
  std::vector<std::string> files;
  if (recording) files = SessionFolder::filesOf(trial, run, presentationsPerTrial(experiment));
  Json record{{"event", "trial_begin"},
              {"trial", trial.number},
              {"practice", trial.practice},
              {"block", trial.block},
              {"repeat", trial.repeat},
              {"attempt", trial.attempt},
              {"run", run},
              {"condition", conditionOf(experiment, trial)},
              {"seed", std::to_string(trial.seed)},
              {"files", files},
              {"utc", utcNow()}};
  if (trial.stimulus) record["stimulus"] = stimulusJson(*trial.stimulus);
  return record;
}

Json trialEnd(const Experiment& experiment, const PlannedTrial& trial, const Conducted& result) {
  Json record{{"event", "trial_end"},
              {"outcome", toString(result.outcome)},
              {"reason", result.reason},
              {"excluded", result.excluded}};
  std::vector<std::vector<double>> values;
  double simulated = 0, wall = 0;
  std::uint64_t ticks = 0;
  for (const TrialResult& shown : result.presented) {
    record["phases"].push_back(phasesOf(experiment, shown));
    if (!shown.facts.empty()) record["model"].push_back(factsJson(shown.facts));
    values.push_back(shown.values);
    simulated += shown.simulated_seconds;
    wall += shown.wall_seconds;
    ticks += shown.ticks;
  }
  const std::vector<RowColumn> columns = rowColumns(experiment);
  const std::vector<double> row = rowValues(experiment, trial, values, result.response);
  for (std::size_t i = 0; i < columns.size(); ++i) record["values"][columns[i].name] = numberOrNull(row[i]);
  if (result.response) record["response"] = {{"chosen", result.response->chosen}, {"value", result.response->value}};
  record["simulated_s"] = simulated;
  record["wall_s"] = wall;
  record["ticks"] = ticks;
  record["faults"] = result.presented.back().faults;
  return record;
}

}  // namespace presa::experiment
