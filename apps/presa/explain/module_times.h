#pragma once
#include <cstdint>
#include <map>
#include <string>

#include "framework/core/graph/graph.h"
#include "framework/core/schedule/rates.h"

namespace presa {

/// Wall time of one module's step with the publication of its outputs, over the ticks of a run [ns]. The time of
/// reading the clock is subtracted.
struct ModuleTime {
  double median_ns = 0;
  double p999_ns = 0;
  std::uint64_t ticks = 0;
};

/// Runs the graph in lockstep for `duration` simulated seconds, stepping its modules one by one. Returns the times by
/// module name.
std::map<std::string, ModuleTime> measureModuleTimes(Graph& graph, const RateTable& rates, double duration);

}  // namespace presa
