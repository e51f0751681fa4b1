#pragma once
#include <string>
#include <vector>

#include "apps/experiment/simulate/studies.h"
#include "experiments/runner/definition/definition.h"

namespace presa::experiment {

/// One number of an analysis over all studies.
struct Spread {
  std::string table, row, column;
  std::size_t studies = 0;                     ///< number of studies that have it
  double mean = 0, sd = 0, low = 0, high = 0;  ///< low, high: 2.5 % and 97.5 % quantiles over the studies
  double power = -1;                           ///< for a p value: share of the studies with p < 0.05; otherwise -1
};

/// Analyses every study as its experiment's file says and writes OUT/power.csv, OUT/power_curve.csv, OUT/power.html and
/// OUT/studies.csv (every number of every study); the power of each test goes to stdout. Returns an exit status.
int reportPower(const StudiesPlan& plan, const Experiment& experiment);

}  // namespace presa::experiment
