#pragma once
#include <string>

#include "apps/common/grasp_strength.h"
#include "framework/session/load_world.h"

namespace presa {

/// `presa explain --grasp`: runs the scene in lockstep to the end of its scripted hold, and prints
/// how good the grasp is: a table in plain words, or as JSON the summary's `grasp` (null: nothing was held). Returns
/// the exit status; E125 when no device has a phase whose intent is hold.
int explainGrasp(Loaded loaded, bool as_json);

/// The table: fingers, closure, weakest motion, quality, margin.
std::string graspText(const RunResult& result, const GraspStrength& strength);

}  // namespace presa
