#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "apps/common/report/svg_plot.h"
#include "apps/common/report/svg_save.h"
#include "apps/common/report/svg_scale.h"
#include "apps/common/report/svg_symbols.h"

namespace presa::svg {
namespace {

constexpr double kWorkWidth = 520, kWorkHeight = 400;  // [px]
constexpr std::size_t kManyPoints = 1000;              // more are thinned
constexpr double kPlace = 10;  // side of a square in which one of them stands for all: their size [px]
constexpr double kWorkLeft = 62, kWorkRight = 506, kWorkTop = 30, kWorkBottom = 350;  // plotting area

/// Logarithmic map from data to pixels.
struct LogScale {
  Scale scale;
  double operator()(double value) const { return scale(std::log10(value)); }
};

struct Span {
  double low = INFINITY, high = 0;
  void include(double value) {
    if (!(value > 0) || !std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  /// With a margin, and never narrower than half a decade.
  LogScale over(double pixel_low, double pixel_high) const {
    const double middle = 0.5 * (std::log10(low) + std::log10(high));
    const double half = std::max(0.25, 0.56 * (std::log10(high) - std::log10(low)));
    return {{middle - half, middle + half, pixel_low, pixel_high}};
  }
};

std::string powerText(int exponent) {
  if (exponent >= -3 && exponent <= 4) return number(std::pow(10.0, exponent), 12);
  return "1e" + std::to_string(exponent);
}

/// Ticks at decades; with intermediate ticks if there are few decades.
std::vector<std::pair<double, std::string>> ticks(const LogScale& scale) {
  std::vector<std::pair<double, std::string>> found;
  const double low = scale.scale.data_low, high = scale.scale.data_high;
  const bool fine = high - low < 2.5, finest = high - low < 1.1;
  for (int e = static_cast<int>(std::floor(low)); e <= static_cast<int>(std::ceil(high)); ++e) {
    for (const double lead : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0}) {
      const double at = e + std::log10(lead);
      const bool shown = lead == 1 || (fine && (lead == 2 || lead == 5)) || finest;
      if (at < low || at > high || !shown) continue;
      const double value = std::pow(10.0, at);
      found.emplace_back(value, lead == 1 ? powerText(e) : number(value, e >= -3 && e <= 4 ? 12 : 2));
    }
  }
  return found;
}

std::string axes(const WorkFigure& figure, const LogScale& x, const LogScale& y) {
  std::string out;
  if (figure.floor > 0) {
    const double top = std::clamp(y(figure.floor), kWorkTop, kWorkBottom);
    out += "<rect class=\"floor\" x=\"" + px(kWorkLeft) + "\" y=\"" + px(top) + "\" width=\"" +
           px(kWorkRight - kWorkLeft) + "\" height=\"" + px(kWorkBottom - top) + "\"/>\n";
  }
  for (const auto& [value, text] : ticks(x))
    out += lineFromTo(x(value), kWorkTop, x(value), kWorkBottom, "grid") +
           textAt(x(value), kWorkBottom + 16, "tick xtick", text);
  for (const auto& [value, text] : ticks(y))
    out += lineFromTo(kWorkLeft, y(value), kWorkRight, y(value), "grid") +
           textAt(kWorkLeft - 8, y(value) + 4, "tick ytick", text);
  out += lineFromTo(kWorkLeft, kWorkBottom, kWorkRight, kWorkBottom, "axis") +
         lineFromTo(kWorkLeft, kWorkTop, kWorkLeft, kWorkBottom, "axis");
  out += textAt(0.5 * (kWorkLeft + kWorkRight), kWorkBottom + 38, "tick xtick", escape(figure.x_label));
  return out + "<text class=\"tick xtick\" transform=\"translate(14 " + px(0.5 * (kWorkTop + kWorkBottom)) +
         ") rotate(-90)\">" + escape(figure.y_label) + "</text>\n";
}

std::string levels(const WorkFigure& figure, const LogScale& x, const LogScale& y) {
  std::string out;
  for (const Level& level : figure.x_levels) {
    out += lineFromTo(x(level.value), kWorkTop, x(level.value), kWorkBottom, "level " + level.css_class);
    out += "<text class=\"level-label\" transform=\"translate(" + px(x(level.value) - 5) + " " + px(kWorkTop + 6) +
           ") rotate(-90)\">" + escape(level.label) + "</text>\n";
  }
  for (const Level& level : figure.y_levels) {
    out += lineFromTo(kWorkLeft, y(level.value), kWorkRight, y(level.value), "level " + level.css_class);
    out += textAt(kWorkLeft + 8, y(level.value) - 5, "known", escape(level.label));
  }
  return out;
}

double heightOf(const WorkPoint& point, const LogScale& y) {
  return point.failed ? kWorkTop + 8 : point.at.y > 0 ? std::min(y(point.at.y), kWorkBottom) : kWorkBottom;
}

std::string symbol(const WorkPoint& point, const LogScale& x, const LogScale& y, bool below_floor) {
  const double at = x(point.at.x);
  std::string data = " data-name=\"" + escape(point.label) + "\"><title>" + escape(point.label) + "</title>";
  if (point.failed) {
    const double top = kWorkTop + 8;
    return "<path class=\"cross\" d=\"M" + px(at - 5) + " " + px(top - 5) + "l10 10m0 -10l-10 10\"" + data +
           "</path>\n";
  }
  const double height = heightOf(point, y);
  std::string out;
  if (point.x_high > point.x_low && point.x_low > 0)
    out += lineFromTo(x(point.x_low), height, x(point.x_high), height, "whisker");
  if (point.color >= 0 && point.css_class != "usual")
    return out + "<path class=\"work " + colorClass(point.color) + " " + point.css_class +
           (below_floor ? " empty" : "") + "\" d=\"" + symbolPath(at, height, 5, point.shape) + "\"" + data +
           "</path>\n";
  const std::string css = "point " + point.css_class + (below_floor ? " empty" : "");
  if (point.css_class == "usual") {
    out +=
        "<path class=\"" + css + "\" d=\"M" + px(at) + " " + px(height - 8) + "l8 8l-8 8l-8 -8z\"" + data + "</path>\n";
  } else {
    out +=
        "<circle class=\"" + css + "\" cx=\"" + px(at) + "\" cy=\"" + px(height) + "\" r=\"5\"" + data + "</circle>\n";
  }
  return out;
}

/// The figure with one point for each place; the default and the front stay whole.
WorkFigure thinned(const WorkFigure& figure, const LogScale& x, const LogScale& y) {
  WorkFigure out = figure;
  std::set<std::pair<int, int>> taken;
  std::erase_if(out.points, [&](const WorkPoint& point) {
    const auto place = [](double at) { return static_cast<int>(std::floor(at / kPlace)); };
    const bool is_new = taken.insert({place(x(point.at.x)), place(heightOf(point, y))}).second;
    return point.css_class == "other" && !is_new;
  });
  for (WorkPoint& point : out.points)
    if (point.css_class == "other") point.x_low = point.x_high = point.at.x;
  return out;
}

Csv csvOf(const WorkFigure& figure) {
  Csv csv({"setting", figure.x_label, figure.x_label + " low", figure.x_label + " high", figure.y_label});
  for (const WorkPoint& point : figure.points)
    csv.row(point.label, {point.at.x, point.x_low, point.x_high, point.failed ? NAN : point.at.y});
  for (const Point& point : figure.front) csv.row("line", {point.x, NAN, NAN, point.y});
  return csv;
}

/// Direct labels, as far as there is room: the default's, those of the front, then the others. Colours, the legend and
/// the pointer tell the rest.
std::string tags(const WorkFigure& figure, const LogScale& x, const LogScale& y) {
  std::vector<PointLabel> labels;
  std::vector<Box> taken;
  for (const char* which : {"usual", "front", "other"}) {
    for (const WorkPoint& point : figure.points) {
      if (point.css_class != which) continue;
      const Point at{x(point.at.x), heightOf(point, y)};
      const bool usual = point.css_class == "usual";
      if (usual || point.css_class == "front") taken.push_back({at.x - 6, at.y - 6, at.x + 6, at.y + 6});
      if (!point.tag.empty()) labels.push_back({at, point.tag, usual});
    }
  }
  for (const Level& level : figure.y_levels)
    taken.push_back({kWorkLeft, y(level.value) - 17, kWorkLeft + 8 + textWidth(level.label), y(level.value)});
  return pointLabels(labels, {kWorkLeft + 2, kWorkTop, kWorkRight + 8, kWorkBottom - 2}, taken);
}

/// Rows of symbols and their meaning; `bottom` becomes the height of the figure.
std::string legendBelow(const WorkFigure& figure, double& bottom) {
  std::string out;
  double at = kWorkLeft, line = kWorkHeight + 12;
  for (const WorkFigure::Entry& entry : figure.entries) {
    const double width = 30 + textWidth(entry.label);
    if (at > kWorkLeft && at + width > kWorkRight) {
      at = kWorkLeft;
      line += 19;
    }
    out += "<path class=\"work front " + colorClass(entry.color) + "\" d=\"" +
           symbolPath(at + 5, line - 4, 5, entry.shape) + "\"/>\n" +
           textAt(at + 15, line, "legend", escape(entry.label));
    at += width;
    bottom = line + 10;
  }
  return out;
}

}  // namespace

std::string render(const WorkFigure& whole) {
  Span x_span, y_span;
  for (const WorkPoint& point : whole.points) {
    for (const double x : {point.at.x, point.x_low, point.x_high}) x_span.include(x);
    if (!point.failed) y_span.include(point.at.y);
  }
  if (!(x_span.high > 0)) return "<p class=\"empty\">No setting was timed.</p>\n";
  for (const Level& level : whole.x_levels) x_span.include(level.value);
  for (const Level& level : whole.y_levels) y_span.include(level.value);
  if (!(y_span.high > 0)) y_span = {0.1, 1};
  const LogScale x = x_span.over(kWorkLeft, kWorkRight), y = y_span.over(kWorkBottom, kWorkTop + 16);
  const bool many = whole.points.size() > kManyPoints;
  const WorkFigure figure = many ? thinned(whole, x, y) : whole;

  double bottom = kWorkHeight;
  const std::string below = legendBelow(figure, bottom);
  std::string out = "<svg viewBox=\"0 0 " + px(kWorkWidth) + " " + px(bottom) + "\" role=\"img\" aria-label=\"" +
                    escape(figure.title) + "\">\n" + levels(figure, x, y) + axes(figure, x, y);
  if (!figure.legend.empty()) out += textAt(kWorkLeft + 10, kWorkTop + 14, "legend", escape(figure.legend));
  if (many)
    out += textAt(kWorkLeft + 10, kWorkTop - 8, "legend",
                  std::to_string(figure.points.size()) + " of " + std::to_string(whole.points.size()) +
                      " drawn, one at each place");
  std::string path;
  for (const Point& point : figure.front)
    path += (path.empty() ? "M" : "L") + px(x(point.x)) + " " +
            px(point.y > 0 ? std::min(y(point.y), kWorkBottom) : kWorkBottom);
  if (figure.front.size() > 1) out += "<path class=\"pareto\" d=\"" + path + "\"/>\n";
  // draw the default last, so that no other point hides it
  for (const bool usual : {false, true}) {
    for (const WorkPoint& point : figure.points) {
      if ((point.css_class == "usual") == usual) out += symbol(point, x, y, point.at.y <= figure.floor);
    }
  }
  return withSaveLinks("plot", out + tags(figure, x, y) + below + "</svg>", "<div class=\"readout\" hidden></div>",
                       figure.title, csvOf(figure));
}

}  // namespace presa::svg
