#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "framework/core/graph/graph.h"
#include "framework/core/schedule/rates.h"

namespace presa {

/// Wall time over the ticks of a run [ns]. What reading the clock takes is taken off.
struct TickTime {
  double median_ns = 0;
  double p999_ns = 0;
  std::uint64_t ticks = 0;
};

/// One module's step with the publication of its outputs, and each of its stages; no stages where the module is not one of
/// WatchedStages.
struct ModuleTime {
  TickTime step;
  std::vector<TickTime> stages;
};

/// Runs the graph in lockstep for `duration` simulated seconds, stepping its modules one by one. Every other tick, by chance,
/// is timed stage by stage: the clock between the stages then does not count for the step. By module name.
std::map<std::string, ModuleTime> measureModuleTimes(Graph& graph, const RateTable& rates, double duration);

}  // namespace presa
