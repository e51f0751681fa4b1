#pragma once
#include <optional>
#include <string>

#include "experiments/runner/definition/definition.h"

namespace presa::experiment {

/// Quality figures of every trial, which a rule for exclusion may ask for beside columns and measures.
inline const std::vector<std::string> kQualityNames{"missed_ticks", "clipped_s", "device_lost_s", "most_force"};

/// Reads an experiment file with its scene and rig: names, expressions and paths are resolved, and every condition's scene is
/// loaded once. `rig`: instead of the file's own; may be empty. `simulated`: level of a simulated subject, who holds the rig that the
/// file names for it. `seed`: instead of the file's own; 0: that. All findings go to `diagnostics` (E9xx, and those of scene and rig); null when there are errors.
std::optional<Experiment> readExperiment(const std::string& file, const std::string& rig, Diagnostics& diagnostics,
                                         const std::string& simulated = {}, std::uint64_t seed = 0);

/// For data that are there already: what a file says of its trials without their scene. Factors, method, design, names and
/// units of measures (no expressions), analysis. All findings go to `diagnostics`; null when there are errors.
std::optional<Experiment> readRecorded(const std::string& file, Diagnostics& diagnostics);

}  // namespace presa::experiment
