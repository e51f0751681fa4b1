#pragma once
#include <string>
#include <vector>

#include "apps/experiment/simulate/studies.h"
#include "experiments/runner/definition/definition.h"

namespace presa::experiment {

/// Analyses every study as its experiment's file says and writes OUT/power.csv, OUT/power_curve.csv, OUT/power.html and
/// OUT/studies.csv (every number of every study); the power of each test goes to stdout. Returns an exit status.
int reportPower(const StudiesPlan& plan, const Experiment& experiment);

}  // namespace presa::experiment
