#pragma once
#include "apps/experiment/journal.h"
#include "experiments/runner/definition/definition.h"

namespace presa::experiment {

/// SHA-256 of every file that an experiment's scene and rig name in any condition of a subject (meshes, motions), by its path
/// from the experiment's folder. Throws std::system_error when one cannot be read.
Json inputSums(const Experiment& experiment, int subject_number);

/// Throws InputError E936 with every file that is not what `sums` say, or is new since.
void checkInputs(const Experiment& experiment, int subject_number, const Json& sums);

}  // namespace presa::experiment
