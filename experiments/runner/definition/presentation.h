#pragma once
#include <string>
#include <vector>

#include "experiments/runner/definition/order.h"

namespace presa::experiment {

/// One run of the scene within a trial: the whole of it, or one interval.
struct Presentation {
  std::vector<std::string> sets;  ///< PATH=VALUE for scene and rig
  std::vector<double> columns;    ///< numbers of the trial's columns, in the order of Experiment::names
};

/// What a trial presents, in its order; one, but for intervals and adjustment.
std::vector<Presentation> presentationsOf(const Experiment& experiment, const PlannedTrial& trial);
/// The comparison at another level than planned: a round of adjustment.
Presentation comparisonAt(const Experiment& experiment, const PlannedTrial& trial, double level);

/// The numbers drawn for a trial, in the order of Experiment::varied.
std::vector<double> variedOf(const Experiment& experiment, const PlannedTrial& trial);

}  // namespace presa::experiment
