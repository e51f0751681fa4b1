#pragma once
#include <optional>
#include <string>

#include "experiments/runner/definition/definition.h"

namespace presa::experiment {

/// Quality figures of every trial. Exclusion rules may use them besides columns and measures.
inline const std::vector<std::string> kQualityNames{"missed_ticks", "clipped_s", "device_lost_s", "most_force"};

/// Reads an experiment file with its scene and rig, resolves names, expressions and paths, and loads the scene of every
/// condition once. `rig` replaces the rig of the file; may be empty. `simulated`: level of a simulated subject, which
/// uses the file's simulated_rig. `seed` replaces the seed of the file unless it is 0. All findings go to `diagnostics`
/// (E9xx, and those of scene and rig); nullopt on errors.
std::optional<Experiment> readExperiment(const std::string& file, const std::string& rig, Diagnostics& diagnostics,
                                         const std::string& simulated = {}, std::uint64_t seed = 0);

/// Reads an experiment file for existing data, without its scene and rig: factors, method, design, names and units of
/// measures (no expressions), analysis. All findings go to `diagnostics`; nullopt on errors.
std::optional<Experiment> readRecorded(const std::string& file, Diagnostics& diagnostics);

}  // namespace presa::experiment
