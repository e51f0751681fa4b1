#pragma once
#include "apps/studies/cost/evidence.h"
#include "apps/studies/cost/study.h"
#include "experiments/study/study_run.h"

namespace presa::cost {

/// One run of a setting watched closely: accuracy, not time. Throws InputError for bad input.
Evidence watch(const StudySpec& spec, const Study& study);

/// What free bodies that touch nothing do, on the same grid.
Evidence analyticAnswer(const StudySpec& spec);

/// One run of a setting that nobody watches: time and memory.
Timing timeRun(const StudySpec& spec);

/// Instructions per simulated second of the whole program, start-up taken off, as valgrind counts them: the cost that is the
/// same on a busy machine. Throws std::runtime_error when valgrind is missing or fails.
double countInstructions(const StudySpec& spec);

}  // namespace presa::cost
