#include "apps/presa/explain/cost.h"

#include <cxxabi.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <typeinfo>

#include "apps/presa/explain/instruction_counts.h"
#include "apps/presa/explain/module_times.h"
#include "apps/presa/terminal/text.h"

namespace presa {
namespace {

using nlohmann::json;

constexpr double kLongest = 10;  // [s] of the scene
constexpr double kNoScript = 2;  // [s] when nothing says how long it is

void say(const char* what) {
  if (::isatty(STDERR_FILENO) != 0) std::fprintf(stderr, "%s\n", what);
}

double lengthOf(const Session& session) {
  double end = 0;
  for (const auto& device : session.devices()) {
    const auto times = device->phaseTimes();
    if (!times.empty()) end = std::max(end, times.back());
  }
  return end > 0 ? std::min(end, kLongest) : kNoScript;
}

std::string functionOf(const Module& module) {
  const char* mangled = typeid(module).name();
  const std::unique_ptr<char, void (*)(void*)> name(abi::__cxa_demangle(mangled, nullptr, nullptr, nullptr), std::free);
  return std::string(name ? name.get() : mangled) + "::step";
}

void addTimes(json& run, const std::map<std::string, ModuleTime>& times) {
  for (json& module : run["modules"]) {
    const ModuleTime& time = times.at(module["name"].get<std::string>());
    module["median_ns"] = time.median_ns;
    module["p999_ns"] = time.p999_ns;
    module["ticks"] = time.ticks;
  }
}

// Ticks are counted by the module's step: a stage runs once a tick or once a finger.
void addCounts(json& run, Graph& graph, const std::map<std::string, FunctionCost>& costs) {
  std::map<std::string, double> ticks;
  for (json& module : run["modules"]) {
    const auto name = module["name"].get<std::string>();
    const auto cost = costOf(costs, functionOf(*graph.find(name)));
    module["instructions_per_tick"] = json();
    if (!cost) continue;
    ticks[name] = static_cast<double>(cost->calls);
    module["instructions_per_tick"] = static_cast<double>(cost->instructions) / ticks[name];
  }
  for (json& stage : run["stages"]) {
    stage["instructions_per_tick"] = json();
    const auto module = ticks.find(stage["module"].get<std::string>());
    if (module == ticks.end() || !stage["function"].is_string()) continue;
    const auto cost = costOf(costs, stage["function"].get<std::string>());
    stage["instructions_per_tick"] = cost ? static_cast<double>(cost->instructions) / module->second : 0;
  }
}

}  // namespace

void addCost(json& run, const Inputs& inputs, const Loaded& loaded, Session& session) {
  const double length = lengthOf(session);
  const std::string seconds = terminal::format("%.3g s of the scene", length);
  say(("measuring time: " + seconds + ", in lockstep").c_str());
  addTimes(run, measureModuleTimes(session.graph(), RateTable(loaded.world->scene.rates), length));
  say(("counting instructions: " + seconds + " under valgrind, about a hundred times slower").c_str());
  const auto counts = countInstructions(inputs, length);
  if (counts) addCounts(run, session.graph(), *counts);
  run["cost"] = {{"simulated_s", length},
                 {"time", "time: " + seconds + " in lockstep, a clock read before and after each module"},
                 {"instructions", counts ? "instructions: mean over " + seconds + ", counted by valgrind"
                                         : std::string("instructions: not available: install valgrind")}};
}

}  // namespace presa
