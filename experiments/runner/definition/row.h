#pragma once
#include <optional>
#include <string>
#include <vector>

#include "experiments/runner/definition/order.h"

namespace presa::experiment {

/// One number of a trial's row, as logs, tables and analyses name it.
struct RowColumn {
  std::string name, unit, description;
};

/// Columns in order: factors and varied numbers, stimulus, the method's question and the answer, measures, quality
/// figures. With two intervals the stimulus and each measure appear twice, as NAME_1 and NAME_2; an adjustment reports
/// its final presentation.
std::vector<RowColumn> rowColumns(const Experiment& experiment);

/// Values of rowColumns(); NaN for a word or a missing value. `presented`: values of Experiment::names for each
/// presentation made, at least one.
std::vector<double> rowValues(const Experiment& experiment, const PlannedTrial& trial,
                              const std::vector<std::vector<double>>& presented,
                              const std::optional<psychophysics::Response>& response);

/// Reserved names of a method's question and answer; no column or measure may use them.
inline const std::vector<std::string> kAnswerNames{"level",  "standard_place", "track", "catch_trial",
                                                   "chosen", "positive",       "set"};

}  // namespace presa::experiment
