#include "apps/presa/explain/cost.h"

#include <cxxabi.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <sstream>
#include <typeinfo>

#include "apps/common/terminal/text.h"
#include "apps/presa/explain/instruction_counts.h"
#include "apps/presa/explain/module_times.h"

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

void addTime(json& row, const TickTime& time) {
  row["median_ns"] = time.median_ns;
  row["p999_ns"] = time.p999_ns;
  row["ticks"] = time.ticks;
}

// Calls use(stage, module's name, number of the stage in its module, whether it is the only one).
template <class Use>
void forEachStage(json& run, const Use& use) {
  std::map<std::string, std::size_t> counts, seen;
  for (const json& stage : run["stages"]) ++counts[stage["module"].get<std::string>()];
  for (json& stage : run["stages"]) {
    const auto module = stage["module"].get<std::string>();
    use(stage, module, seen[module]++, counts[module] == 1);
  }
}

void addTimes(json& run, const std::map<std::string, ModuleTime>& times) {
  for (json& module : run["modules"]) addTime(module, times.at(module["name"].get<std::string>()).step);
  forEachStage(run, [&](json& stage, const std::string& module, std::size_t number, bool only) {
    const ModuleTime& time = times.at(module);
    stage["median_ns"] = stage["p999_ns"] = json();
    if (number < time.stages.size()) {
      addTime(stage, time.stages[number]);
    } else if (only) {
      addTime(stage, time.step);
    }
  });
}

// Instructions of "a + b - c", functions by name. One that never ran cost nothing.
double sumOf(const std::map<std::string, FunctionCost>& costs, const std::string& functions) {
  double sum = 0, sign = 1;
  std::istringstream words(functions);
  std::string name;
  const auto add = [&] {
    const auto cost = costOf(costs, name);
    sum += cost ? sign * static_cast<double>(cost->instructions) : 0;
    name.clear();
  };
  for (std::string word; words >> word;) {
    if (word == "+" || word == "-") {
      add();
      sign = word == "+" ? 1 : -1;
    } else {
      name += (name.empty() ? "" : " ") + word;
    }
  }
  add();
  return sum;
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
  forEachStage(run, [&](json& stage, const std::string& name, std::size_t, bool only) {
    stage["instructions_per_tick"] = json();
    const auto count = ticks.find(name);
    if (count == ticks.end()) return;
    if (stage["function"].is_string()) {
      stage["instructions_per_tick"] = sumOf(costs, stage["function"].get<std::string>()) / count->second;
    } else if (only) {
      stage["instructions_per_tick"] =
          static_cast<double>(costOf(costs, functionOf(*graph.find(name)))->instructions) / count->second;
    }
  });
}

}  // namespace

void addCost(json& run, const Inputs& inputs, const Loaded& loaded, Session& session) {
  const double length = lengthOf(session);
  const std::string seconds = terminal::format("%.3g s of the scene", length);
  say(("measuring time: " + seconds + ", in lockstep").c_str());
  addTimes(run, measureModuleTimes(session.graph(), RateTable(loaded.world->scene.rates), length));
  say(("counting instructions: " + seconds + " under valgrind, about a hundred times slower").c_str());
  const auto counts = countInstructions(inputs, length, !loaded.world->options.record.empty());
  if (counts) addCounts(run, session.graph(), *counts);
  run["cost"] = {
      {"simulated_s", length},
      {"time", "time: " + seconds +
                   " in lockstep, by a clock before and after each module, and between stages in half of the ticks"},
      {"instructions", counts ? "instructions: mean over " + seconds + ", counted by valgrind"
                              : std::string("instructions: not available: install valgrind")}};
}

}  // namespace presa
