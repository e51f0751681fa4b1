#pragma once
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "apps/studies/cost/trace.h"
#include "framework/core/math/spatial.h"

namespace presa::cost {

nlohmann::json toJson(const Evidence& evidence);
Evidence evidenceFrom(const nlohmann::json& json);  ///< without the trace

/// Cost of one run. Times are processor time of the thread.
struct Timing {
  struct Group {
    std::string name;
    double period = 0;  ///< [s]
    std::uint64_t ticks = 0;
    double mean = 0, median = 0, p999 = 0;  ///< per tick [s], without the cost of reading the clock
  };
  std::string hardware;              ///< that it ran on, as hardwareText()
  std::vector<std::string> engines;  ///< with versions
  double per_second = 0;             ///< processor time of all groups per simulated second [-]
  std::vector<Group> groups;
  double load = 0;          ///< from reading the files to the first tick [s]
  double memory = 0;        ///< growth of the process [B]
  double instructions = 0;  ///< per simulated second; 0: not counted

  /// 99.9 % of the ticks of the busiest rate group cost less than this part of its period [-].
  double busiestTick() const;
};

nlohmann::json toJson(const Timing& timing);
Timing timingFrom(const nlohmann::json& json);

}  // namespace presa::cost
