#include "apps/studies/cost/knob_plots.h"

#include <algorithm>
#include <map>
#include <optional>

#include "apps/common/report/svg_plot.h"
#include "apps/common/terminal/text.h"
#include "apps/studies/cost/analysis.h"
#include "apps/studies/cost/metrics.h"
#include "apps/studies/cost/verdict.h"
#include "apps/studies/cost/work_plots.h"

namespace presa::cost {
namespace {

constexpr std::size_t kFewest = 3;  // points of a plot

/// The settings that differ from the default in this knob at most, by its value.
std::map<double, const Outcome*> along(const Result& result, const std::string& knob) {
  std::map<double, const Outcome*> line;
  const auto& usual = result.outcomes.front().setting.choices;
  for (const Outcome& outcome : result.outcomes) {
    std::optional<double> value;
    bool alone = true;
    for (std::size_t k = 0; k < usual.size(); ++k) {
      const auto& [name, choice] = outcome.setting.choices[k];
      if (name == knob)
        value = numberIn(choice);
      else
        alone = alone && choice == usual[k].second;
    }
    if (alone && value && *value > 0) line.emplace(*value, &outcome);
  }
  return line;
}

std::string figureOf(const Result& result, const Metric& metric, const std::string& knob,
                     const std::map<double, const Outcome*>& line) {
  svg::WorkFigure figure;
  figure.title = metric.title + " over " + knob;
  figure.x_label = knob;
  figure.y_label = metric.title + (metric.unit == "steps" ? "" : " [" + metric.unit + "]");
  figure.floor = result.resolution(metric.name);
  const Outcome& usual = result.outcomes.front();
  for (const auto& [value, outcome] : line) {
    const auto error = outcome->error.find(metric.name);
    const bool failed = !outcome->failure.empty();
    if (!failed && error == outcome->error.end()) continue;
    const double height = failed ? 0 : error->second;
    const std::string what = failed ? "failed: " + outcome->failure : withUnit(height, metric.unit);
    figure.points.push_back({.at = {value, height},
                             .x_low = value,
                             .x_high = value,
                             .label = outcome->setting.name + "\n" + what,
                             .css_class = outcome == &usual ? "usual" : "front",
                             .failed = failed});
    if (!failed && height > 0) figure.front.push_back({value, height});
  }
  if (figure.front.size() < kFewest) return {};
  const bool drawn = std::ranges::any_of(line, [&](const auto& each) { return each.second == &usual; });
  const auto error = usual.error.find(metric.name);
  if (!drawn && error != usual.error.end() && error->second > 0)
    figure.y_levels.push_back({error->second, "default", ""});
  const auto [low, high] = std::ranges::minmax(figure.front, {}, &svg::Point::y);
  const auto limit = result.reference.noticeable.find(metric.name);
  if (limit != result.reference.noticeable.end() && isNear(limit->second, low.y, high.y))
    figure.y_levels.push_back({limit->second, "just noticeable", ""});
  const auto order = std::ranges::find_if(
      result.orders, [&](const Order& each) { return each.factor == knob && each.metric == metric.name; });
  const std::string words = order == result.orders.end() ? "" : terminal::format(": order %.2f", order->order);
  return "<figure><h3>" + svg::escape(knob + words) + "</h3>\n" + svg::render(figure) + "</figure>\n";
}

}  // namespace

std::string knobPlots(const Result& result) {
  const std::vector<std::string> names = judgedMetrics(result);
  if (names.empty() || result.outcomes.empty()) return {};
  const Metric& metric = *findMetric(names.front());
  std::string figures;
  for (const Factor& factor : result.study.factors) {
    figures += figureOf(result, metric, factor.name, along(result, factor.name));
  }
  if (figures.empty()) return {};
  return "<p class=\"caption\">" + svg::escape(metric.title) +
         ", over one knob at a time; all others as in the scene.</p>\n<div class=\"pair\">\n" + figures + "</div>\n";
}

}  // namespace presa::cost
