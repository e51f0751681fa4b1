#pragma once
#include <string>
#include <vector>

#include "apps/experiment/subject.h"
#include "experiments/runner/definition/definition.h"
#include "experiments/runner/definition/order.h"

namespace presa::experiment {

/// Duration of a trial [s]: `min` when every awaited event happens at once, `max` when none happens.
struct Span {
  double min = 0, max = 0;
};
Span durationOf(const Experiment& experiment);

/// All trials of a session. Where a method chooses the levels, the answers are simulated at 75 % correct.
std::vector<PlannedTrial> previewTrials(const Experiment& experiment, int subject_number, int session);

/// The trials as text, as a CSV table and as JSON.
std::string dryRunText(const Experiment& experiment, const Subject& subject, int session,
                       const std::vector<PlannedTrial>& trials);
std::string dryRunCsv(const Experiment& experiment, const std::vector<PlannedTrial>& trials);
std::string dryRunJson(const Experiment& experiment, const Subject& subject, int session,
                       const std::vector<PlannedTrial>& trials);

}  // namespace presa::experiment
