#pragma once
#include "apps/experiment/journal.h"
#include "experiments/runner/definition/definition.h"

namespace presa::experiment {

/// SHA-256 of every file (mesh, motion) that an experiment's scene and rig name in any condition of a subject. Keys are
/// paths relative to the experiment's folder. Throws std::system_error when a file cannot be read.
Json inputSums(const Experiment& experiment, int subject_number);

/// Throws InputError E936 that lists every file whose checksum differs from `sums`, and every file missing from `sums`.
void checkInputs(const Experiment& experiment, int subject_number, const Json& sums);

}  // namespace presa::experiment
