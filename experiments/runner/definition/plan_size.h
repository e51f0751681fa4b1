#pragma once
#include "experiments/runner/definition/definition.h"
#include "framework/core/diagnostics/diagnostics.h"

namespace presa::experiment {

/// Size of a design, computed before any trial is planned. Doubles, because the product of the levels may overflow an
/// integer.
struct PlanSize {
  double conditions = 1;  ///< combinations of all levels over all subjects; each is loaded once to check it
  double trials = 0;      ///< of one session, at most
};
PlanSize planSize(const Experiment& experiment);

inline constexpr double kMaxConditions = 1000;
inline constexpr double kMaxTrialsOfSession = 10000;

/// Reports E694 at `where` and returns false when the design exceeds these limits.
bool checkPlanSize(const Experiment& experiment, const SourceLocation& where, Diagnostics& diagnostics);

}  // namespace presa::experiment
