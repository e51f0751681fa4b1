#pragma once
#include "apps/studies/cost/evidence.h"
#include "apps/studies/cost/study.h"
#include "experiments/study/study_run.h"

namespace presa::cost {

/// Runs a setting and collects its accuracy figures; not for timing. Throws InputError for bad input.
Evidence watch(const StudySpec& spec, const Study& study);

/// The analytic motion of free bodies without contact, on the same time grid.
Evidence analyticAnswer(const StudySpec& spec);

/// Runs a setting without observers and measures time and memory.
Timing timeRun(const StudySpec& spec);

/// Instructions of the whole program per simulated second, without start-up, counted by valgrind: a cost that does not
/// depend on the load of the machine. Throws std::runtime_error when valgrind is missing or fails.
double countInstructions(const StudySpec& spec);

}  // namespace presa::cost
