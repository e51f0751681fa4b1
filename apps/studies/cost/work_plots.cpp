#include "apps/studies/cost/work_plots.h"

#include <algorithm>

#include "apps/common/report/page.h"
#include "apps/common/report/svg_plot.h"
#include "apps/common/terminal/text.h"
#include "apps/studies/cost/analysis.h"
#include "apps/studies/cost/metrics.h"

namespace presa::cost {
namespace {

using svg::escape;
using terminal::format;

struct CostAxis {
  std::string label;
  double scale = 1;
  CostOf cost = nullptr;
  svg::Level period;
};

svg::WorkFigure figureOf(const Result& result, const std::string& name, const CostAxis& axis) {
  const Metric& metric = *findMetric(name);
  svg::WorkFigure figure;
  figure.title = metric.title + " over cost";
  figure.x_label = axis.label;
  figure.y_label = metric.title + (metric.unit == "steps" ? "" : " [" + metric.unit + "]");
  figure.x_levels.push_back(axis.period);
  figure.floor = result.resolution(name);
  const auto noticeable = result.reference.noticeable.find(name);
  if (noticeable != result.reference.noticeable.end())
    figure.y_levels.push_back({noticeable->second, "just noticeable", ""});
  const std::vector<std::size_t> front = paretoFront(result, name, axis.cost);
  for (std::size_t i = 0; i < result.outcomes.size(); ++i) {
    const Outcome& outcome = result.outcomes[i];
    const auto error = outcome.error.find(name);
    const bool failed = !outcome.failure.empty();
    if (!outcome.timed() || (!failed && error == outcome.error.end())) continue;
    const Spread cost = (outcome.*axis.cost)();
    svg::WorkPoint point;
    point.at = {axis.scale * cost.median, failed ? 0 : error->second};
    point.x_low = axis.scale * cost.low;
    point.x_high = axis.scale * cost.high;
    point.failed = failed;
    const bool best = std::find(front.begin(), front.end(), i) != front.end();
    point.css_class = i == 0 ? "usual" : best ? "front" : "other";
    point.label = outcome.setting.name + "\n" +
                  (failed ? "failed: " + outcome.failure
                   : result.resolved(outcome, name)
                       ? withUnit(error->second, metric.unit)
                       : "below the reference's resolution of " + withUnit(result.resolution(name), metric.unit)) +
                  format("\n%.3g ms per simulated second", 1e3 * outcome.perSecond().median) +
                  format("\nbusiest tick %.3g of its period", outcome.busiestTick().median);
    figure.points.push_back(point);
  }
  for (const std::size_t i : front) {
    const Outcome& outcome = result.outcomes[i];
    figure.front.push_back({axis.scale * (outcome.*axis.cost)().median, outcome.error.at(name)});
  }
  return figure;
}

CostAxis totalAxis() {
  return {"processor time [ms per simulated second]", 1e3, &Outcome::perSecond, {1e3, "one second per second", ""}};
}

}  // namespace

std::string workPlots(const Result& result) {
  const CostAxis total = totalAxis();
  const CostAxis tick{"busiest rate group: 99.9 % of ticks below [parts of its period]",
                      1,
                      &Outcome::busiestTick,
                      {1, "one tick = its period", ""}};
  std::string out =
      "<h2>Error over cost</h2>\n<p class=\"caption\">◆ the scene as it stands. ● on the line: no setting is both "
      "cheaper and "
      "better. ○ in the shaded ground: below the reference's resolution (ten times its residual), no better than its "
      "edge. ✕ failed. Whiskers: "
      "spread of the repeats. Point at a symbol for its setting.</p>\n";
  for (const std::string& name : result.metrics) {
    const Metric& metric = *findMetric(name);
    out += "<h3>" + escape(metric.title) + "</h3>\n<p class=\"caption\"><code>" + name +
           "</code>: " + escape(metric.meaning) + ".";
    if (const double limit = result.resolution(name); limit > 0)
      out += " Residual of the reference: " + escape(withUnit(limit / 10, metric.unit)) + ".";
    out += "</p>\n<div class=\"pair\"><div>" + svg::render(figureOf(result, name, total)) + "</div><div>" +
           svg::render(figureOf(result, name, tick)) + "</div></div>\n";
  }
  return out;
}

std::string frontPicture(const Result& result) {
  if (result.metrics.empty()) return {};
  std::string metric = result.metrics.front();
  for (const SentenceRule& rule : result.study.sentences) {
    if (std::find(result.metrics.begin(), result.metrics.end(), rule.metric) == result.metrics.end()) continue;
    metric = rule.metric;
    break;
  }
  return page::picture(svg::render(figureOf(result, metric, totalAxis())), result.study.title);
}

}  // namespace presa::cost
