#include "apps/studies/cost/report_tables.h"

#include <set>
#include <vector>

#include "apps/common/report/html.h"
#include "apps/common/report/svg_plot.h"
#include "apps/common/terminal/text.h"
#include "apps/studies/cost/analysis.h"
#include "apps/studies/cost/metrics.h"

namespace presa::cost {
namespace {

using html::row;
using html::table;
using svg::escape;
using terminal::format;

constexpr std::size_t kManySettings = 500;  // more do not stand in one table

/// The error, or its upper bound when the reference does not resolve it.
std::string claimText(const Result& result, const Outcome& outcome, const std::string& metric) {
  return (result.resolved(outcome, metric) ? "" : "≲ ") +
         format("%.3g", result.resolved(outcome, metric) ? outcome.error.at(metric) : result.resolution(metric));
}

std::string gainTable(const Result& result, const std::string& metric) {
  std::string rows;
  for (const FactorGain& gain : factorGains(result, metric)) {
    const std::string per =
        gain.per_double_cost ? format("%.3g", *gain.per_double_cost) : std::string("no measurable cost");
    rows += row({escape(gain.factor), escape(gain.from + " → " + gain.to), format("%.3g", gain.cost_ratio),
                 format("%.3g", gain.error_ratio), per});
  }
  if (rows.empty()) return {};
  const Metric& m = *findMetric(metric);
  return "<h3>" + escape(m.title) + "</h3>\n" +
         table({"knob", "from the default to", "processor time ×", "error ×", "error × for twice the cost"}, rows);
}

/// The settings that the table shows: of thousands the default, those on a front, and the first others.
std::vector<std::size_t> shownSettings(const Result& result) {
  std::set<std::size_t> shown;
  if (!result.outcomes.empty()) shown.insert(0);
  if (result.outcomes.size() > kManySettings) {
    for (const std::string& metric : result.metrics)
      for (const Judged& each : frontOf(result, metric)) shown.insert(each.index);
  }
  for (std::size_t i = 0; i < result.outcomes.size() && shown.size() < kManySettings; ++i) shown.insert(i);
  return {shown.begin(), shown.end()};
}

}  // namespace

std::string gains(const Result& result) {
  std::string out;
  for (const std::string& name : result.metrics) out += gainTable(result, name);
  if (out.empty()) return {};
  return "<p class=\"caption\">One knob turned, all others as in the scene. Below 1: "
         "better. The last column "
         "compares knobs: the error that remains if this knob alone were turned until the cost is doubled.</p>\n" +
         out;
}

namespace {

/// Table cells of a chosen setting: costs, and its --set options to paste.
std::vector<std::string> chosenCells(const Result& result, std::optional<std::size_t> index) {
  if (!index) return {"none", "", ""};
  const Outcome& best = result.outcomes[*index];
  const std::string line = best.setting.sets.empty() ? "the scene as it stands"
                                                     : "<code>" + escape(setOptions(best.setting.sets)) + "</code>";
  return {format("%.3g", 1e3 * best.perSecond().median), format("%.3g", best.busiestTick().median), line};
}

}  // namespace

std::string choice(const Result& result) {
  std::string rows;
  const auto add = [&](std::vector<std::string> cells, const std::vector<std::string>& chosen) {
    cells.insert(cells.end(), chosen.begin(), chosen.end());
    rows += row(cells);
  };
  for (const std::string& name : result.metrics) {
    const auto limit = result.reference.noticeable.find(name);
    if (limit == result.reference.noticeable.end()) continue;
    const Metric& metric = *findMetric(name);
    const auto found = cheapestBelow(result, name, limit->second);
    const std::string error = found ? claimText(result, result.outcomes[*found], name) + " " + metric.unit : "";
    add({escape(metric.title), escape(withUnit(limit->second, metric.unit)), escape(error)},
        chosenCells(result, found));
  }
  if (rows.empty()) return {};
  add({"<b>all of these</b>", "", ""}, chosenCells(result, cheapestUnfelt(result)));
  return table(
      {"error", "just noticeable", "its error", "ms per simulated second", "busiest tick / period", "to paste"}, rows);
}

std::string frontDistances(const Result& result) {
  std::string rows;
  const auto named = [&](double ratio, std::size_t index) {
    return ratio > 1 ? escape(result.outcomes[index].setting.name) : std::string("none");
  };
  for (const std::string& name : result.metrics) {
    const auto distance = distanceToFront(result, name);
    if (!distance) continue;
    rows += row({escape(findMetric(name)->title), format("%.4g", distance->cost),
                 named(distance->cost, distance->as_accurate), format("%.4g", distance->error),
                 named(distance->error, distance->as_cheap),
                 distance->ratio() <= 1            ? "on the front"
                 : distance->ratio() <= kNearFront ? "within 1.3 ×"
                                                   : "<span class=\"fault\">beyond 1.3 ×</span>"});
  }
  if (rows.empty()) return {};
  return "<p class=\"caption\">Among the settings of its own engine, without latency and late ticks. Costs within 5 % "
         "count as the same.</p>\n" +
         table({"error", "cost ×", "against the cheapest as accurate", "error ×", "against the most accurate as cheap",
                "the default is"},
               rows);
}

std::string settings(const Result& result) {
  std::vector<std::string> head{"setting"};
  for (const std::string& name : result.metrics) head.push_back(name + " [" + findMetric(name)->unit + "]");
  for (const char* cost : {"CPU [ms/s]", "spread", "busiest tick / period", "haptic tick p50 / p99.9 [µs]", "collision",
                           "dynamics", "memory [MB]", "load [ms]", "million instructions / s"})
    head.emplace_back(cost);
  std::string rows;
  const std::vector<std::size_t> shown = shownSettings(result);
  for (const std::size_t i : shown) {
    const Outcome& outcome = result.outcomes[i];
    std::vector<std::string> cells{escape(outcome.setting.name)};
    if (!outcome.failure.empty()) cells[0] += "<br><span class=\"fault\">✕ " + escape(outcome.failure) + "</span>";
    for (const std::string& name : result.metrics) {
      const auto error = outcome.error.find(name);
      cells.push_back(error == outcome.error.end() ? "" : claimText(result, outcome, name));
    }
    if (outcome.timed()) {
      const Spread cpu = outcome.perSecond();
      cells.push_back(format("%.3g", 1e3 * cpu.median));
      cells.push_back(format("%.3g … %.3g", 1e3 * cpu.low, 1e3 * cpu.high));
      cells.push_back(format("%.3g", outcome.busiestTick().median));
      for (const char* group : {"haptic", "collision", "dynamics"}) {
        std::string text;
        for (const Timing::Group& g : outcome.timings.front().groups) {
          if (g.name == group) text = format("%.3g / %.3g", 1e6 * g.median, 1e6 * g.p999);
        }
        cells.push_back(text);
      }
      cells.push_back(format("%.3g", 1e-6 * outcome.memory().median));
      cells.push_back(format("%.3g", 1e3 * outcome.load().median));
      cells.push_back(outcome.instructions > 0 ? format("%.4g", 1e-6 * outcome.instructions) : "");
    }
    cells.resize(head.size());
    rows += row(cells);
  }
  const std::string some = shown.size() == result.outcomes.size()
                               ? ""
                               : format("%zu of %zu settings: the default, those on a front, and the first others. ",
                                        shown.size(), result.outcomes.size());
  return table(head, rows) + "<p class=\"caption\">" + some +
         "Tick times: the first repeat. The same in cost.csv and, with every repeat, in "
         "cost.json.</p>\n";
}

std::string meshes(const Result& result) {
  std::string rows;
  for (const Result::Mesh& mesh : result.meshes)
    rows += row({escape(mesh.body + " " + mesh.value), format("%zu", mesh.source_triangles),
                 format("%zu", mesh.triangles), format("%.3g", 1e3 * mesh.hausdorff)});
  if (rows.empty()) return {};
  return table({"mesh", "triangles before", "after", "Hausdorff distance [thousandths of a file unit: mm]"}, rows);
}

}  // namespace presa::cost
