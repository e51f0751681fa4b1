#pragma once
#include <optional>
#include <string>
#include <vector>

#include "experiments/runner/definition/order.h"

namespace presa::experiment {

/// The numbers of one trial as logs, tables and analyses know them.
struct RowColumn {
  std::string name, unit, description;
};

/// Columns of factors and varied numbers; the stimulus; what the method asked and the answer; measures; quality. With two intervals
/// the stimulus and each measure come twice, NAME_1 and NAME_2; of an adjustment, as it was set.
std::vector<RowColumn> rowColumns(const Experiment& experiment);

/// Values of rowColumns(); NaN for a word or what is not there. `presented`: values of Experiment::names for each presentation that was
/// made, at least one.
std::vector<double> rowValues(const Experiment& experiment, const PlannedTrial& trial,
                              const std::vector<std::vector<double>>& presented,
                              const std::optional<psychophysics::Response>& response);

/// Names of a method's question and its answer: no column or measure can have them.
inline const std::vector<std::string> kAnswerNames{"level",  "standard_place", "track", "catch_trial",
                                                   "chosen", "positive",       "set"};

}  // namespace presa::experiment
