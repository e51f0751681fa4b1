#pragma once
#include <string>
#include <vector>

#include "experiments/runner/definition/order.h"

namespace presa::experiment {

/// One run of the scene within a trial: the whole trial or one interval of it.
struct Presentation {
  std::vector<std::string> sets;  ///< PATH=VALUE overrides for scene and rig
  std::vector<double> columns;    ///< numeric columns of the trial, in the order of Experiment::names
};

/// The presentations of a trial in order: one, or two for tasks with intervals and for adjustment.
std::vector<Presentation> presentationsOf(const Experiment& experiment, const PlannedTrial& trial);
/// The comparison at another level than planned: the next round of an adjustment.
Presentation comparisonAt(const Experiment& experiment, const PlannedTrial& trial, double level);

/// The random numbers drawn for a trial, in the order of Experiment::varied.
std::vector<double> variedOf(const Experiment& experiment, const PlannedTrial& trial);

}  // namespace presa::experiment
