#include "experiments/runner/definition/row.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "experiments/runner/definition/read.h"

namespace presa::experiment {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

const std::array<RowColumn, 4> kQuality{{{"missed_ticks", "", "haptic ticks that began more than a period late"},
                                         {"clipped_s", "s", "time at the force limit"},
                                         {"device_lost_s", "s", "time in which a device gave no sample"},
                                         {"most_force", "N", "largest force on a finger"}}};

bool inPairs(const Experiment& experiment) {
  return experiment.procedure && experiment.procedure->task == Task::kTwoIntervals;
}

void addColumn(const RowColumn& column, bool pairs, std::vector<RowColumn>& columns) {
  if (!pairs) return columns.push_back(column);
  for (const char* interval : {"1", "2"})
    columns.push_back({column.name + "_" + interval, column.unit, column.description + ", interval " + interval});
}

std::vector<RowColumn> answerColumns(const Experiment& experiment) {
  const std::string meaning = experiment.procedure->coding == psychophysics::Coding::kCorrect
                                  ? "1: the answer was right"
                                  : "1: the comparison was called the greater one";
  std::vector<RowColumn> columns{{"level", "", "of the comparison, on the axis of the method; 0 is the standard"},
                                 {"track", "", "which staircase or constant level, from 0"},
                                 {"catch_trial", "", "1: checks attention, counts in no fit"}};
  if (experiment.procedure->task == Task::kAdjust) {
    columns.push_back({"set", "", "level where the participant stopped; `level` is where it started"});
    return columns;
  }
  columns.push_back({"standard_place", "", "interval or side of the standard; 0: there is none"});
  columns.push_back({"chosen", "", "the answer: 1 first, left or yes; 2 second, right or no"});
  columns.push_back({"positive", "", meaning});
  return columns;
}

double answerOf(const std::string& name, const psychophysics::Stimulus& stimulus,
                const std::optional<psychophysics::Response>& response) {
  if (name == "level") return stimulus.level;
  if (name == "track") return static_cast<double>(stimulus.track);
  if (name == "catch_trial") return stimulus.kind == psychophysics::TrialKind::kCatch ? 1 : 0;
  if (name == "standard_place") return stimulus.standard_place;
  if (!response) return kNothing;
  if (name == "chosen") return response->chosen;
  if (name == "positive") return response->positive ? 1 : 0;
  return response->value;
}

/// The largest value over all presentations.
double worst(const std::vector<std::vector<double>>& presented, std::size_t slot) {
  double max = -std::numeric_limits<double>::infinity();
  for (const std::vector<double>& values : presented) max = std::max(max, values[slot]);
  return max;
}

}  // namespace

std::vector<RowColumn> rowColumns(const Experiment& experiment) {
  const bool pairs = inPairs(experiment);
  std::vector<RowColumn> columns;
  for (const Factor& factor : experiment.factors) {
    for (const Column& column : factor.columns) columns.push_back({column.name, column.unit, "factor " + factor.name});
  }
  for (const Vary& vary : experiment.varied) columns.push_back({vary.column.name, vary.column.unit, "drawn anew"});
  if (experiment.procedure) {
    const Column& stimulus = experiment.procedure->stimulus.column;
    addColumn({stimulus.name, stimulus.unit, "stimulus"}, pairs, columns);
    for (const RowColumn& column : answerColumns(experiment)) columns.push_back(column);
  }
  for (const Measure& measure : experiment.measures)
    addColumn({measure.name, measure.unit, measure.description}, pairs, columns);
  columns.insert(columns.end(), kQuality.begin(), kQuality.end());
  return columns;
}

std::vector<double> rowValues(const Experiment& experiment, const PlannedTrial& trial,
                              const std::vector<std::vector<double>>& presented,
                              const std::optional<psychophysics::Response>& response) {
  const bool pairs = inPairs(experiment);
  std::vector<double> row;
  for (const RowColumn& column : rowColumns(experiment)) {
    const bool is_answer = std::find(kAnswerNames.begin(), kAnswerNames.end(), column.name) != kAnswerNames.end();
    if (experiment.procedure && is_answer) {
      row.push_back(answerOf(column.name, *trial.stimulus, response));
    } else if (const auto slot = experiment.names.find(column.name)) {
      const bool quality = std::find(kQualityNames.begin(), kQualityNames.end(), column.name) != kQualityNames.end();
      row.push_back(quality ? worst(presented, *slot) : presented.back()[*slot]);
    } else {  // NAME_1, NAME_2
      const std::size_t interval = pairs && column.name.back() == '2' ? 1 : 0;
      const auto of = experiment.names.find(column.name.substr(0, column.name.size() - 2));
      row.push_back(interval < presented.size() ? presented[interval][*of] : kNothing);
    }
  }
  return row;
}

}  // namespace presa::experiment
