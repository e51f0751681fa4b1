#pragma once
#include <optional>
#include <string>
#include <vector>

#include "apps/experiment/simulate/studies.h"
#include "experiments/runner/definition/definition.h"

namespace presa::experiment {

/// What `presa experiment simulate` was asked for.
struct Simulation {
  StudiesPlan plan;                 ///< with absolute paths
  std::vector<std::string> varied;  ///< settings of the devices (variations.h)
};

/// Runs the incomplete sessions of the shard, and, unless it is one of several, analyses all studies. Returns the exit
/// status. Throws InputError: E951 the folder is another's or cannot be made, E952 nothing simulates its subjects, E954.
int simulate(const Simulation& wanted);

/// The experiment with the plan's devices, which are all simulated (otherwise E952); null: it cannot be read, and why is
/// told on stderr.
std::optional<Experiment> readSimulated(const StudiesPlan& plan);
/// All that the sessions of the plan depend on, but for their number.
std::string planText(const StudiesPlan& plan, const Experiment& experiment);

}  // namespace presa::experiment
