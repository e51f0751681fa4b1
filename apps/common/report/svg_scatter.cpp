#include <algorithm>
#include <cmath>
#include <set>

#include "apps/common/report/svg_plot.h"
#include "apps/common/report/svg_save.h"
#include "apps/common/report/svg_scale.h"

namespace presa::svg {
namespace {

constexpr double kScatterWidth = 520;                                        // [px]
constexpr double kScatterLeft = 56, kScatterRight = 506, kPlotHeight = 336;  // plotting area
constexpr double kScatterTop = 14, kEntryHeight = 18;  // the legend is above it, where no ray crosses it
constexpr double kBelow = 50;                          // its axis and that axis' title

/// Dots as zero-length strokes, each pixel position once, so that thousands of samples make a small file.
std::string dots(const Cloud& cloud, const Scale& x, const Scale& y) {
  if (cloud.points.empty()) return {};
  std::set<std::pair<long, long>> drawn;
  std::string path;
  for (const Point& point : cloud.points) {
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) continue;
    const std::pair<long, long> at{std::lround(2 * x(point.x)), std::lround(2 * y(point.y))};
    if (!drawn.insert(at).second) continue;
    path += "M" + px(0.5 * static_cast<double>(at.first)) + " " + px(0.5 * static_cast<double>(at.second)) + "h0";
  }
  return "<path class=\"dots " + cloud.css_class + "\" d=\"" + path + "\"/>\n";
}

std::string axes(const ScatterFigure& figure, const Scale& x, const Scale& y) {
  std::string out;
  const double bottom = y.pixel_low, top = y.pixel_high;
  const auto x_ticks = niceTicks(0, x.data_high, 8);
  const auto y_ticks = niceTicks(0, y.data_high, 7);
  for (const double value : x_ticks) {
    out += lineFromTo(x(value), top, x(value), bottom, "grid");
    out += textAt(x(value), bottom + 16, "tick xtick", tickText(value, x_ticks[1] - x_ticks[0]));
  }
  for (const double value : y_ticks) {
    out += lineFromTo(kScatterLeft, y(value), kScatterRight, y(value), "grid");
    out += textAt(kScatterLeft - 8, y(value) + 4, "tick ytick", tickText(value, y_ticks[1] - y_ticks[0]));
  }
  out += lineFromTo(kScatterLeft, bottom, kScatterRight, bottom, "axis") +
         lineFromTo(kScatterLeft, top, kScatterLeft, bottom, "axis");
  out += textAt(0.5 * (kScatterLeft + kScatterRight), bottom + 38, "tick xtick", escape(figure.x_label));
  out += "<text class=\"tick xtick\" transform=\"translate(14 " + px(0.5 * (top + bottom)) + ") rotate(-90)\">" +
         escape(figure.y_label) + "</text>\n";
  return out;
}

std::string ray(const Ray& line, const Scale& x, const Scale& y) {
  const double end = line.slope > 0 ? std::min(x.data_high, y.data_high / line.slope) : x.data_high;
  return lineFromTo(x(0), y(0), x(end), y(line.slope * end), "ray " + line.css_class);
}

std::string mark(const Mark& m, const Scale& x, const Scale& y) {
  return "<circle class=\"mark " + m.css_class + "\" cx=\"" + px(x(m.at.x)) + "\" cy=\"" + px(y(m.at.y)) +
         "\" r=\"6\"><title>" + escape(m.label) + "</title></circle>\n";
}

std::string legend(const ScatterFigure& figure) {
  std::string out;
  double y = kScatterTop;
  const auto entry = [&](const std::string& symbol, const std::string& label) {
    out += symbol + textAt(kScatterLeft + 34, y, "legend", escape(label));
    y += kEntryHeight;
  };
  const double at = kScatterLeft + 20;
  for (const Ray& line : figure.rays)
    entry(lineFromTo(at - 9, y - 4, at + 9, y - 4, "ray " + line.css_class), line.label);
  for (const Cloud& cloud : figure.clouds) {
    if (cloud.points.empty()) continue;
    entry("<path class=\"dots big " + cloud.css_class + "\" d=\"M" + px(at) + " " + px(y - 4) + "h0\"/>", cloud.label);
  }
  for (const Mark& m : figure.marks) {
    entry("<circle class=\"mark " + m.css_class + "\" cx=\"" + px(at) + "\" cy=\"" + px(y - 4) + "\" r=\"5\"/>",
          m.label);
  }
  return out;
}

Csv csvOf(const ScatterFigure& figure) {
  Csv csv({"what", figure.x_label, figure.y_label});
  for (const Cloud& cloud : figure.clouds)
    for (const Point& point : cloud.points) csv.row(cloud.label, {point.x, point.y});
  for (const Mark& m : figure.marks) csv.row(m.label, {m.at.x, m.at.y});
  return csv;
}

}  // namespace

std::string render(const ScatterFigure& figure) {
  double x_high = 0, y_high = 0;
  const auto include = [&](const Point& point) {
    if (std::isfinite(point.x)) x_high = std::max(x_high, point.x);
    if (std::isfinite(point.y)) y_high = std::max(y_high, point.y);
  };
  for (const Cloud& cloud : figure.clouds) std::for_each(cloud.points.begin(), cloud.points.end(), include);
  for (const Mark& m : figure.marks) include(m.at);
  if (!(x_high > 0)) return "<p class=\"empty\">No contact to plot.</p>\n";
  y_high = std::max(1.05 * y_high, 0.3 * x_high);  // at least one ray in view
  const auto clouds = std::ranges::count_if(figure.clouds, [](const Cloud& cloud) { return !cloud.points.empty(); });
  const auto entries = static_cast<double>(figure.rays.size() + figure.marks.size()) + static_cast<double>(clouds);
  const double top = kScatterTop + kEntryHeight * entries;
  const Scale x{0, 1.05 * x_high, kScatterLeft, kScatterRight};
  const Scale y{0, y_high, top + kPlotHeight, top};

  std::string out = "<svg viewBox=\"0 0 " + px(kScatterWidth) + " " + px(top + kPlotHeight + kBelow) +
                    "\" role=\"img\" aria-label=\"" + escape(figure.title) + "\">\n" + axes(figure, x, y);
  for (const Cloud& cloud : figure.clouds) out += dots(cloud, x, y);
  for (const Ray& line : figure.rays) out += ray(line, x, y);
  for (const Mark& m : figure.marks) out += mark(m, x, y);
  return withSaveLinks("plot", out + legend(figure) + "</svg>", {}, figure.title, csvOf(figure));
}

}  // namespace presa::svg
