#include "apps/presa/explain/cost.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "apps/common/terminal/text.h"
#include "apps/presa/explain/module_times.h"

namespace presa {
namespace {

using nlohmann::json;

constexpr double kLongest = 10;  // longest simulated time [s]
constexpr double kNoScript = 2;  // simulated time of a scene without a script [s]

void say(const std::string& what) {
  if (::isatty(STDERR_FILENO) != 0) std::fprintf(stderr, "%s\n", what.c_str());
}

double lengthOf(const Session& session) {
  double end = 0;
  for (const auto& device : session.devices()) {
    const auto times = device->phaseTimes();
    if (!times.empty()) end = std::max(end, times.back());
  }
  return end > 0 ? std::min(end, kLongest) : kNoScript;
}

double periodOf(const json& run, const json& module) {
  for (const json& thread : run["threads"]) {
    if (thread["name"] == module["group"]) return thread["period_s"].get<double>();
  }
  return 0;
}

}  // namespace

void addCost(json& run, Session& session) {
  const double length = lengthOf(session);
  const std::string seconds = terminal::format("%.3g s of the scene", length);
  say("measuring time: " + seconds + ", in lockstep");
  const auto times = measureModuleTimes(session.graph(), RateTable(session.world()->scene.rates), length);
  for (json& module : run["modules"]) {
    const ModuleTime& time = times.at(module["name"].get<std::string>());
    module["median_ns"] = time.median_ns;
    module["p999_ns"] = time.p999_ns;
    module["ticks"] = time.ticks;
    module["share_of_period"] = time.median_ns * 1e-9 / periodOf(run, module);
  }
  run["cost"] = {{"simulated_s", length},
                 {"time", "wall time of each module's step over " + seconds +
                              " in lockstep, on one thread; share: the median over the period of its thread"}};
}

}  // namespace presa
