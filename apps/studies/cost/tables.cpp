#include "apps/studies/cost/tables.h"

#include <nlohmann/json.hpp>

#include "apps/common/terminal/text.h"
#include "apps/common/version.h"
#include "apps/studies/cost/analysis.h"
#include "apps/studies/cost/metrics.h"

namespace presa::cost {
namespace {

using nlohmann::json;

json toJson(const Spread& spread) { return {{"median", spread.median}, {"low", spread.low}, {"high", spread.high}}; }

json toJson(const FrontDistance& distance, const Result& result) {
  return {{"cost", distance.cost},
          {"error", distance.error},
          {"near", distance.ratio() <= kNearFront},
          {"as_accurate", result.outcomes[distance.as_accurate].setting.name},
          {"as_cheap", result.outcomes[distance.as_cheap].setting.name}};
}

json toJson(const Outcome& outcome, const Result& result) {
  json factors = json::object();
  for (const auto& [factor, value] : outcome.setting.choices) factors[factor] = value;
  json row{{"name", outcome.setting.name}, {"knobs", factors}, {"set", outcome.setting.sets}, {"error", outcome.error}};
  json unresolved = json::array();
  for (const std::string& name : result.metrics) {
    if (!result.resolved(outcome, name)) unresolved.push_back(name);
  }
  row["below_resolution"] = unresolved;
  row["failure"] = outcome.failure.empty() ? json(nullptr) : json(outcome.failure);
  if (!outcome.timed()) return row;
  row["cpu_per_simulated_s"] = toJson(outcome.perSecond());
  row["busiest_tick_of_period"] = toJson(outcome.busiestTick());
  row["load_s"] = toJson(outcome.load());
  row["memory_B"] = toJson(outcome.memory());
  if (outcome.instructions > 0) row["instructions_per_simulated_s"] = outcome.instructions;
  for (const Timing& timing : outcome.timings) row["repeats"].push_back(cost::toJson(timing));
  return row;
}

std::string csvText(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + "\"";
}

std::string number(double value) { return terminal::format("%.9g", value); }

}  // namespace

std::string toJsonText(const Result& result) {
  const Study& study = result.study;
  json metrics = json::array();
  for (const std::string& name : result.metrics) {
    const Metric& metric = *findMetric(name);
    json entry{{"name", name}, {"unit", metric.unit}, {"meaning", metric.meaning}, {"absolute", metric.absolute}};
    if (const double limit = result.resolution(name); limit > 0) {
      entry["reference_residual"] = limit / 10;
      entry["resolution"] = limit;
    }
    if (const auto distance = distanceToFront(result, name)) entry["default_over_front"] = toJson(*distance, result);
    if (const auto found = result.reference.noticeable.find(name); found != result.reference.noticeable.end())
      entry["just_noticeable"] = found->second;
    metrics.push_back(entry);
  }
  json settings = json::array();
  for (const Outcome& outcome : result.outcomes) settings.push_back(toJson(outcome, result));
  json meshes = json::array();
  for (const Result::Mesh& mesh : result.meshes) {
    meshes.push_back({{"body", mesh.body},
                      {"value", mesh.value},
                      {"triangles", mesh.triangles},
                      {"source_triangles", mesh.source_triangles},
                      {"hausdorff", mesh.hausdorff}});
  }
  json orders = json::array();
  for (const Order& order : result.orders)
    orders.push_back(
        {{"knob", order.factor}, {"metric", order.metric}, {"order", order.order}, {"values", order.values}});
  json machine = json::object();
  for (const auto& [key, value] : result.machine) machine[key] = value;
  const json all{{"study", study.name},
                 {"scene", study.inputs.scene},
                 {"seed", study.seed},
                 {"repeats", study.repeats},
                 {"version", kVersion},
                 {"command", result.command},
                 {"interrupted", result.interrupted},
                 {"reference",
                  {{"analytic", study.reference_kind == Study::Reference::kAnalytic},
                   {"set", result.reference.sets},
                   {"kept", result.reference.kept},
                   {"residual_below_a_tenth_of_the_smallest_error", result.reference.fine_enough}}},
                 {"metrics", metrics},
                 {"orders", orders},
                 {"meshes", meshes},
                 {"machine", machine},
                 {"settings", settings}};
  return all.dump(1) + "\n";
}

std::string toCsv(const Result& result) {
  std::string out = "setting";
  for (const Factor& factor : result.study.factors) out += "," + csvText(factor.name);
  for (const std::string& name : result.metrics) out += "," + name + "_" + findMetric(name)->unit;
  out +=
      ",cpu_ms_per_s,cpu_ms_per_s_low,cpu_ms_per_s_high,busiest_tick_of_period,load_ms,memory_MB,instructions_per_s,"
      "below_resolution,failure,set\n";
  for (const Outcome& outcome : result.outcomes) {
    out += csvText(outcome.setting.name);
    for (const auto& [factor, value] : outcome.setting.choices) out += "," + csvText(value);
    for (const std::string& name : result.metrics) {
      const auto error = outcome.error.find(name);
      out += "," + (error == outcome.error.end() ? "" : number(error->second));
    }
    if (outcome.timed()) {
      const Spread cpu = outcome.perSecond();
      out += "," + number(1e3 * cpu.median) + "," + number(1e3 * cpu.low) + "," + number(1e3 * cpu.high) + "," +
             number(outcome.busiestTick().median) + "," + number(1e3 * outcome.load().median) + "," +
             number(1e-6 * outcome.memory().median) + "," +
             (outcome.instructions > 0 ? number(outcome.instructions) : "");
    } else {
      out += ",,,,,,,";
    }
    std::string sets;
    for (const std::string& set : outcome.setting.sets) sets += (sets.empty() ? "" : " ") + set;
    std::string unresolved;
    for (const std::string& name : result.metrics) {
      if (!result.resolved(outcome, name)) unresolved += (unresolved.empty() ? "" : " ") + name;
    }
    out += "," + csvText(unresolved) + "," + csvText(outcome.failure) + "," + csvText(sets) + "\n";
  }
  return out;
}

std::string toRunsCsv(const Result& result) {
  std::string out = "setting";
  for (const Factor& factor : result.study.factors) out += "," + csvText(factor.name);
  out += ",repeat,cpu_ms_per_s,busiest_tick_of_period,load_ms,memory_MB,hardware\n";
  for (const Outcome& outcome : result.outcomes) {
    std::string setting = csvText(outcome.setting.name);
    for (const auto& [factor, value] : outcome.setting.choices) setting += "," + csvText(value);
    for (std::size_t repeat = 0; repeat < outcome.timings.size(); ++repeat) {
      const Timing& timing = outcome.timings[repeat];
      out += setting + "," + std::to_string(repeat + 1) + "," + number(1e3 * timing.per_second) + "," +
             number(timing.busiestTick()) + "," + number(1e3 * timing.load) + "," + number(1e-6 * timing.memory) + "," +
             csvText(timing.hardware) + "\n";
    }
  }
  return out;
}

}  // namespace presa::cost
