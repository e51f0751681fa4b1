#pragma once
#include "framework/core/diagnostics/diagnostics.h"
#include "experiments/runner/definition/definition.h"

namespace presa::experiment {

/// What a design comes to, counted before anything of it is built. Doubles: a product of levels may pass every integer.
struct PlanSize {
  double conditions =
      1;              ///< all combinations of levels, of all subjects: each is loaded once to see that it can be run
  double trials = 0;  ///< of one session, at most
};
PlanSize planSize(const Experiment& experiment);

inline constexpr double kMostConditions = 1000;
inline constexpr double kMostTrialsOfSession = 10000;

/// E694 at `where` when the design comes to more than these.
bool checkPlanSize(const Experiment& experiment, const SourceLocation& where, Diagnostics& diagnostics);

}  // namespace presa::experiment
