#pragma once
#include <string>
#include <vector>

#include "apps/experiment/subject.h"
#include "experiments/runner/definition/definition.h"
#include "experiments/runner/definition/order.h"

namespace presa::experiment {

/// Seconds that a trial takes: `least` when every awaited thing happens at once, `most` when nothing does.
struct Span {
  double least = 0, most = 0;
};
Span durationOf(const Experiment& experiment);

/// All trials of a session, those of a method as somebody meets them who is right three times in four.
std::vector<PlannedTrial> previewTrials(const Experiment& experiment, int subject_number, int session);

/// The same as people read it, as a table (CSV) and as JSON.
std::string dryRunText(const Experiment& experiment, const Subject& subject, int session,
                       const std::vector<PlannedTrial>& trials);
std::string dryRunCsv(const Experiment& experiment, const std::vector<PlannedTrial>& trials);
std::string dryRunJson(const Experiment& experiment, const Subject& subject, int session,
                       const std::vector<PlannedTrial>& trials);

}  // namespace presa::experiment
