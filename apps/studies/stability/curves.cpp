#include "apps/studies/stability/curves.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/common/report/svg_plot.h"
#include "apps/studies/stability/table.h"

namespace presa::stability {
namespace {

constexpr std::size_t kFigures = 2;  // per case
/// Divergent curves are cut off at this many times the span of Presa's curve.
constexpr double kSpan = 2.0;

struct Pair {
  const Row* own = nullptr;
  const Row* replaced = nullptr;  ///< null: no baseline has a curve
  int contrast() const {
    return replaced ? static_cast<int>(replaced->finding.verdict) - static_cast<int>(own->finding.verdict) : -1;
  }
};

std::vector<Pair> pairsOf(const Case& c, const std::vector<Row>& rows) {
  std::vector<Pair> pairs;
  for (const Row& row : rows) {
    if (row.case_name == c.name && row.method == kPresa && !row.finding.curves.empty())
      pairs.push_back({&row, nullptr});
  }
  for (Pair& pair : pairs) {
    for (const Row& row : rows) {
      const bool same = row.case_name == c.name && row.method != kPresa && row.parameters == pair.own->parameters &&
                        row.finding.metric == pair.own->finding.metric && !row.finding.curves.empty();
      if (same && (!pair.replaced || row.finding.verdict > pair.replaced->finding.verdict)) pair.replaced = &row;
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.contrast() > b.contrast(); });
  if (pairs.size() > kFigures) pairs.resize(kFigures);
  return pairs;
}

/// The curve at the given x, by its nearest point; NaN outside of its range.
std::vector<double> sampledAt(const Curve& curve, const std::vector<double>& x) {
  std::vector<double> y;
  for (const double at : x) {
    const auto next = std::lower_bound(curve.x.begin(), curve.x.end(), at);
    auto i = static_cast<std::size_t>(next - curve.x.begin());
    if (i == curve.x.size() || (i > 0 && at - curve.x[i - 1] < curve.x[i] - at)) --i;
    const bool outside = at > curve.x.back() + 1e-9 || at < curve.x.front() - 1e-9;
    y.push_back(outside ? std::numeric_limits<double>::quiet_NaN() : curve.y[i]);
  }
  return y;
}

void clampTo(std::vector<double>& values, const std::vector<svg::Series>& own) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const svg::Series& series : own) {
    for (const double y : series.y) {
      if (std::isfinite(y)) low = std::min(low, y), high = std::max(high, y);
    }
  }
  const double room = kSpan * std::max(high - low, 1e-12 + 0.05 * std::max(std::abs(low), std::abs(high)));
  for (double& value : values) {
    if (!std::isnan(value)) value = std::clamp(value, low - room, high + room);
  }
}

svg::TimeFigure figureOf(const Pair& pair) {
  svg::TimeFigure figure;
  const Finding& own = pair.own->finding;
  figure.title = own.metric;
  figure.time = own.curves.front().x;
  figure.x_label = own.plot_x;
  svg::Panel panel{.title = own.plot_y};
  for (std::size_t i = 0; i < own.curves.size(); ++i) {
    panel.series.push_back(
        {"Presa: " + own.curves[i].label, i == 0 ? "finger" : "proxy", sampledAt(own.curves[i], figure.time)});
  }
  if (pair.replaced) {
    std::vector<double> y = sampledAt(pair.replaced->finding.curves.front(), figure.time);
    clampTo(y, panel.series);
    panel.series.insert(panel.series.begin(), {pair.replaced->method, "object", std::move(y)});
  }
  figure.panels.push_back(std::move(panel));
  return figure;
}

}  // namespace

std::string curvesHtml(const Case& c, const std::vector<Row>& rows) {
  std::string out;
  for (const Pair& pair : pairsOf(c, rows)) {
    out += "<h3>" + svg::escape(parameterText(pair.own->parameters)) + "</h3>\n" + svg::render(figureOf(pair));
  }
  return out;
}

}  // namespace presa::stability
