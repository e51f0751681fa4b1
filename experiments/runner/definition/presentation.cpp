#include "experiments/runner/definition/presentation.h"

#include <array>
#include <charconv>
#include <limits>

#include "framework/core/math/random.h"

namespace presa::experiment {
namespace {

/// The shortest text that reads back as the same number.
std::string textOf(double value) {
  std::array<char, 32> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end};
}

double numberOf(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? value : std::numeric_limits<double>::quiet_NaN();
}

void setAll(const std::vector<std::string>& paths, double value, std::vector<std::string>& sets) {
  for (const std::string& path : paths) sets.push_back(path + "=" + textOf(value));
}

/// Adds the scene values of a stimulus at the first or second place.
void putStimulus(const StimulusAxis& stimulus, double value, bool second, std::vector<std::string>& sets) {
  setAll(second ? stimulus.second_paths : stimulus.column.paths, value, sets);
  for (const StimulusAxis::Coupled& coupled : stimulus.coupled)
    setAll(second ? coupled.second_paths : coupled.paths, coupled.value.evaluate(std::array{value}), sets);
}

Presentation common(const Experiment& experiment, const PlannedTrial& trial) {
  Presentation made{experiment.setsOf(trial.condition), {}};
  for (std::size_t f = 0; f < experiment.factors.size(); ++f) {
    for (const std::string& text : experiment.factors[f].levels[trial.condition[f]])
      made.columns.push_back(numberOf(text));
  }
  const std::vector<double> varied = variedOf(experiment, trial);
  for (std::size_t v = 0; v < varied.size(); ++v) {
    setAll(experiment.varied[v].column.paths, varied[v], made.sets);
    made.columns.push_back(varied[v]);
  }
  return made;
}

Presentation withValue(const Experiment& experiment, const PlannedTrial& trial, double value) {
  Presentation made = common(experiment, trial);
  putStimulus(experiment.procedure->stimulus, value, false, made.sets);
  made.columns.push_back(value);
  return made;
}

}  // namespace

std::vector<double> variedOf(const Experiment& experiment, const PlannedTrial& trial) {
  std::vector<double> drawn;
  for (const Vary& vary : experiment.varied)
    drawn.push_back(RandomStream(trial.seed, "vary " + vary.column.name).uniform(vary.min, vary.max));
  return drawn;
}

Presentation comparisonAt(const Experiment& experiment, const PlannedTrial& trial, double level) {
  return withValue(experiment, trial, experiment.procedure->stimulus.axis.valueAt(level));
}

std::vector<Presentation> presentationsOf(const Experiment& experiment, const PlannedTrial& trial) {
  if (!experiment.procedure) return {common(experiment, trial)};
  const StimulusAxis& stimulus = experiment.procedure->stimulus;
  const double value = stimulus.axis.valueAt(trial.stimulus->level), standard = stimulus.axis.valueAt(0);
  const bool standard_first = trial.stimulus->standard_place != 2;
  switch (experiment.procedure->task) {
    case Task::kTwoIntervals:
      return {withValue(experiment, trial, standard_first ? standard : value),
              withValue(experiment, trial, standard_first ? value : standard)};
    case Task::kTwoAlternatives: {
      Presentation made = common(experiment, trial);
      putStimulus(stimulus, standard_first ? standard : value, false, made.sets);
      putStimulus(stimulus, standard_first ? value : standard, true, made.sets);
      made.columns.push_back(value);
      return {made};
    }
    case Task::kAdjust:
      return {withValue(experiment, trial, standard), withValue(experiment, trial, value)};
    default:
      return {withValue(experiment, trial, value)};
  }
}

}  // namespace presa::experiment
