#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/common/report/svg_range.h"
#include "apps/common/report/svg_time.h"
#include "apps/common/terminal/text.h"

namespace presa::svg {
namespace {

constexpr double kLineHeight = 14, kSpanHeight = 15;  // of labels and of the strips of bodies [px]

Range yRange(const Panel& panel) {
  if (!panel.names.empty())
    return {-0.25, static_cast<double>(panel.names.size()) - (panel.spans.empty() ? 0.75 : 0.2)};
  Range range;
  for (const Series& series : panel.series) {
    for (const auto* values : {&series.y, &series.low, &series.high})
      std::for_each(values->begin(), values->end(), [&](double y) { range.add(y); });
  }
  for (const Level& level : panel.levels) range.add(level.value);
  if (panel.from_zero) range.add(0);
  if (!(range.low <= range.high)) return {0, 1};
  const double span = range.high - range.low;
  const double margin = span > 0 ? 0.06 * span : std::max(1e-3, 0.1 * std::abs(range.high));
  return {panel.from_zero && range.low >= 0 ? 0 : range.low - margin, range.high + margin};
}

std::string stripOf(const Band& band, const std::string& css, const Scale& x, double top, double height) {
  return "<rect class=\"" + css + "\" x=\"" + px(x(band.begin)) + "\" y=\"" + px(top) + "\" width=\"" +
         px(x(band.end) - x(band.begin)) + "\" height=\"" + px(height) + "\"><title>" + escape(band.label) +
         "</title></rect>\n";
}

std::string bandRects(const std::vector<Band>& bands, const Scale& x, double top, double bottom) {
  std::string out;
  for (std::size_t i = 0; i < bands.size(); ++i)
    out += stripOf(bands[i], "band band" + std::to_string(i % 2), x, top, bottom - top);
  return out;
}

std::string spanRects(const std::vector<Band>& spans, const Scale& x, double top) {
  std::string out;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const Band& span = spans[i];
    out += stripOf(span, "span span" + std::to_string(i % 2), x, top, kSpanHeight);
    if (static_cast<double>(terminal::widthOf(span.label)) * kCharacterPx < x(span.end) - x(span.begin))
      out += textAt(0.5 * (x(span.begin) + x(span.end)), top + 11, "tick xtick", escape(span.label));
  }
  return out;
}

std::string yAxis(const Panel& panel, const Range& range, const Scale& x, const Scale& y) {
  std::string out;
  const auto tick = [&](double value, const std::string& label) {
    out += lineFromTo(x.pixel_low, y(value), x.pixel_high, y(value), "grid");
    out += textAt(x.pixel_low - 8, y(value) + 4, "tick ytick", label);
  };
  if (!panel.names.empty()) {
    for (std::size_t i = 0; i < panel.names.size(); ++i) {
      tick(static_cast<double>(i), escape(panel.names[i]) + " " + std::to_string(i));
    }
    return out;
  }
  const std::vector<double> ticks = niceTicks(range.low, range.high, static_cast<int>(panel.height / 34));
  const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : 0;
  for (const double value : ticks) tick(value, tickText(value, step));
  return out;
}

/// Vertical lines of the grid; they lie under the curves.
std::string xGrid(const Scale& x, double top, double bottom) {
  std::string out;
  for (const double t : niceTicks(x.data_low, x.data_high, kTimeTicks))
    out += lineFromTo(x(t), top, x(t), bottom, "grid");
  return out;
}

/// The names of the curves at their ends, moved apart where they would overlap.
std::string endLabels(const Panel& panel, const Scale& x, const Scale& y) {
  struct Label {
    const Series* series;
    std::string text;
    double at;
  };
  std::vector<Label> labels;
  for (const Series& series : panel.series) {
    const auto end = std::find_if(series.y.rbegin(), series.y.rend(), [](double v) { return std::isfinite(v); });
    const std::string text = endLabelOf(panel, series);
    if (!text.empty()) labels.push_back({&series, text, end == series.y.rend() ? y.pixel_low : y(*end)});
  }
  std::stable_sort(labels.begin(), labels.end(), [](const Label& a, const Label& b) { return a.at < b.at; });
  double below = y.pixel_high + 0.5 * kLineHeight;
  for (Label& label : labels) below = (label.at = std::max(label.at, below)) + kLineHeight;
  double above = std::max(y.pixel_low, y.pixel_high + kLineHeight * (static_cast<double>(labels.size()) - 0.5));
  for (auto label = labels.rbegin(); label != labels.rend(); ++label)
    above = (label->at = std::min(label->at, above)) - kLineHeight;
  std::string out;
  const double left = x.pixel_high + 6;
  for (const Label& label : labels) {
    out += lineFromTo(left, label.at, left + kSwatch, label.at, "line " + label.series->css_class);
    out += textAt(left + kSwatch + 4, label.at + 4, "end-label", escape(label.text));
  }
  return out;
}

}  // namespace

std::string endLabelOf(const Panel& panel, const Series& series) {
  if (!panel.names.empty() && panel.series.size() == 1) return {};
  return shortened(series.label, kMaxEndLabel);
}

std::string panelBody(const TimeFigure& figure, const Panel& panel, const Scale& x, double top) {
  const Range range = yRange(panel);
  const double bottom = top + panel.height;
  const Scale y{range.low, range.high, bottom, top};
  const std::string title = panel.title + (panel.unit.empty() ? "" : " [" + panel.unit + "]");
  std::string out = textAt(kTimeLeft, top - 9, "panel-title", escape(title)) + bandRects(figure.bands, x, top, bottom) +
                    xGrid(x, top, bottom) + yAxis(panel, range, x, y) + spanRects(panel.spans, x, top);
  for (const Level& level : panel.levels)
    out += lineFromTo(x.pixel_low, y(level.value), x.pixel_high, y(level.value), "level " + level.css_class);
  for (const Series& series : panel.series)
    out += "<path class=\"line " + series.css_class + "\" d=\"" + linePath(figure, series, x, y) + "\"/>\n";
  for (const Level& level : panel.levels)
    out += textAt(x.pixel_high - 6, y(level.value) - 5, "level-label halo", escape(level.label));
  return out + endLabels(panel, x, y) + lineFromTo(x.pixel_low, bottom, x.pixel_high, bottom, "axis");
}

}  // namespace presa::svg
