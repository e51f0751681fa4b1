#include "apps/studies/cost/work_plots.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "apps/common/report/page.h"
#include "apps/common/report/svg_plot.h"
#include "apps/common/terminal/text.h"
#include "apps/studies/cost/analysis.h"
#include "apps/studies/cost/looks.h"
#include "apps/studies/cost/metrics.h"
#include "apps/studies/cost/verdict.h"

namespace presa::cost {
namespace {

using svg::escape;
using terminal::format;

constexpr std::size_t kOpenPlots = 4;
constexpr std::size_t kAllTagged = 16;  // settings up to which every one gets a direct label

/// What the pointer shows at a setting.
std::string readout(const Result& result, const Outcome& outcome, const std::string& name) {
  const Metric& metric = *findMetric(name);
  return outcome.setting.name + "\n" +
         (!outcome.failure.empty() ? "failed: " + outcome.failure
          : result.resolved(outcome, name)
              ? withUnit(outcome.error.at(name), metric.unit)
              : "below the reference's resolution of " + withUnit(result.resolution(name), metric.unit)) +
         format("\n%.3g ms per simulated second", 1e3 * outcome.perSecond().median) +
         format("\nbusiest tick %.3g of its period", outcome.busiestTick().median);
}

void addLevels(const Result& result, const std::string& name, svg::WorkFigure& figure) {
  double low = INFINITY, high = 0, cost = 0;
  for (const svg::WorkPoint& point : figure.points) {
    cost = std::max(cost, point.at.x);
    if (point.failed || !(point.at.y > 0)) continue;
    low = std::min(low, point.at.y);
    high = std::max(high, point.at.y);
  }
  const auto noticeable = result.reference.noticeable.find(name);
  if (noticeable != result.reference.noticeable.end() && isNear(noticeable->second, low, high))
    figure.y_levels.push_back({noticeable->second, "just noticeable", ""});
  if (cost > 250) figure.x_levels.push_back({1e3, "one second per second", ""});
}

svg::WorkFigure figureOf(const Result& result, const std::string& name, const Looks& looks) {
  const Metric& metric = *findMetric(name);
  svg::WorkFigure figure;
  figure.title = metric.title + " over cost";
  figure.x_label = "processor time [ms per simulated second]";
  figure.y_label = metric.title + (metric.unit == "steps" ? "" : " [" + metric.unit + "]");
  figure.floor = result.resolution(name);
  figure.entries = looks.legend;
  const std::vector<Judged> front = frontOf(result, name);
  for (std::size_t i = 0; i < result.outcomes.size(); ++i) {
    const Outcome& outcome = result.outcomes[i];
    const auto error = outcome.error.find(name);
    const bool failed = !outcome.failure.empty();
    if (!outcome.timed() || (!failed && error == outcome.error.end())) continue;
    const Spread cost = outcome.perSecond();
    const bool best = std::any_of(front.begin(), front.end(), [&](const Judged& each) { return each.index == i; });
    svg::WorkPoint point{.at = {1e3 * cost.median, failed ? 0 : error->second},
                         .x_low = 1e3 * cost.low,
                         .x_high = 1e3 * cost.high,
                         .label = readout(result, outcome, name),
                         .css_class = i == 0 ? "usual"
                                      : best ? "front"
                                             : "other",
                         .failed = failed,
                         .color = looks.of[i].color,
                         .shape = looks.of[i].shape};
    if (i == 0 || best || result.outcomes.size() <= kAllTagged) point.tag = looks.of[i].tag;
    figure.points.push_back(point);
  }
  for (const Judged& each : front)
    figure.front.push_back({1e3 * each.cost.median, result.outcomes[each.index].error.at(name)});
  addLevels(result, name, figure);
  return figure;
}

std::string figureHtml(const Result& result, const std::string& name, const Looks& looks) {
  const Metric& metric = *findMetric(name);
  std::string out = "<figure><h3>" + escape(metric.title) + "</h3>\n" + svg::render(figureOf(result, name, looks)) +
                    "<figcaption class=\"caption\"><code>" + name + "</code>: " + escape(metric.meaning) + ".";
  if (const auto limit = result.reference.noticeable.find(name); limit != result.reference.noticeable.end())
    out += " Just noticeable: " + escape(withUnit(limit->second, metric.unit)) + ".";
  if (const double limit = result.resolution(name); limit > 0)
    out += " Residual of the reference: " + escape(withUnit(limit / 10, metric.unit)) + ".";
  return out + "</figcaption></figure>\n";
}

std::vector<std::string> openMetrics(const Result& result) {
  std::vector<std::string> names = judgedMetrics(result);
  if (names.size() > kOpenPlots) names.resize(kOpenPlots);
  return names;
}

/// A metric's settings and their front.
struct Drawn {
  std::vector<Judged> all, front;
};

/// True when a plot of `b` would repeat that of `a`: the same front, and errors in nearly the same ratios.
bool repeats(const Drawn& a, const Drawn& b) {
  const std::vector<Judged>&x = a.all, &y = b.all;
  const auto same = [](const Judged& p, const Judged& q) { return p.index == q.index; };
  if (!std::equal(a.front.begin(), a.front.end(), b.front.begin(), b.front.end(), same)) return false;
  if (!std::equal(x.begin(), x.end(), y.begin(), y.end(), same)) return false;
  double n = 0, sx = 0, sy = 0, xx = 0, yy = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double p = std::log(x[i].error), q = std::log(y[i].error);
    n += 1, sx += p, sy += q, xx += p * p, yy += q * q, xy += p * q;
  }
  const double spread = (n * xx - sx * sx) * (n * yy - sy * sy);
  return spread > 0 && n * xy - sx * sy > 0.95 * std::sqrt(spread);
}

bool isFlat(const Drawn& drawn) {
  return std::ranges::all_of(drawn.all, [&](const Judged& each) { return each.error == drawn.all.front().error; });
}

}  // namespace

bool isNear(double level, double low, double high) { return level < 10 * high && level > low / 10; }

std::string workPlots(const Result& result) {
  const Looks looks = looksOf(result);
  std::string out =
      "<h2>Error over cost</h2>\n<p class=\"caption\">Large diamond: the scene as it stands. Filled, on the line: no "
      "setting of the "
      "default's engine beats it. Pale: beaten, of another engine, or with latency or late ticks, which nobody "
      "chooses. Hollow, in the shaded ground: below the reference's resolution (ten "
      "times its residual), no better than its edge. ✕ failed. Whiskers: spread of the repeats. Labels: values that "
      "differ from the default's. Costs within 5 % count as the same.</p>\n<div class=\"pair\">\n";
  for (const std::string& name : openMetrics(result)) out += figureHtml(result, name, looks);
  return out + "</div>\n";
}

std::string otherPlots(const Result& result) {
  const Looks looks = looksOf(result);
  std::vector<std::string> drawn = openMetrics(result);
  std::map<std::string, Drawn> settings;
  for (const std::string& name : result.metrics) settings[name] = {judged(result, name), frontOf(result, name)};
  std::string figures, left_out;
  for (const std::string& name : result.metrics) {
    if (std::find(drawn.begin(), drawn.end(), name) != drawn.end()) continue;
    const auto like = std::find_if(drawn.begin(), drawn.end(),
                                   [&](const std::string& other) { return repeats(settings[other], settings[name]); });
    if (isFlat(settings[name])) {
      left_out += "<li>" + escape(findMetric(name)->title) + ": the same in all settings.</li>\n";
    } else if (like != drawn.end()) {
      left_out += "<li>" + escape(findMetric(name)->title) + ": as " + escape(lowered(findMetric(*like)->title)) +
                  ", the same front and nearly the same ratios.</li>\n";
    } else {
      figures += figureHtml(result, name, looks);
      drawn.push_back(name);
    }
  }
  if (!figures.empty()) figures = "<div class=\"pair\">\n" + figures + "</div>\n";
  if (!left_out.empty()) figures += "<h3>Not drawn</h3>\n<ul>\n" + left_out + "</ul>\n";
  return figures;
}

std::string frontPicture(const Result& result) {
  if (result.metrics.empty()) return {};
  return page::picture(svg::render(figureOf(result, judgedMetrics(result).front(), looksOf(result))),
                       result.study.title);
}

}  // namespace presa::cost
