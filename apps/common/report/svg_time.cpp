#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/common/report/svg_plot.h"
#include "apps/common/report/svg_scale.h"

namespace presa::svg {
namespace {

constexpr double kWidth = 1080, kLeft = 70, kRight = 1064;  // [px]
constexpr double kTop = 26, kBottom = 40, kGap = 44;        // above the first panel, below the last, between two
constexpr double kCharacter = 6.6;                          // mean width of the labels' font
constexpr std::size_t kReadouts = 1200;                     // points that the hover read-out knows

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void add(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

Range yRange(const Panel& panel) {
  if (!panel.names.empty()) return {-0.25, static_cast<double>(panel.names.size()) - 0.75};
  Range range;
  for (const Series& series : panel.series)
    std::for_each(series.y.begin(), series.y.end(), [&](double y) { range.add(y); });
  for (const Level& level : panel.levels) range.add(level.value);
  if (panel.from_zero) range.add(0);
  if (!(range.low <= range.high)) return {0, 1};
  const double span = range.high - range.low;
  const double margin = span > 0 ? 0.06 * span : std::max(1e-3, 0.1 * std::abs(range.high));
  return {panel.from_zero && range.low >= 0 ? 0 : range.low - margin, range.high + margin};
}

std::string bandRects(const std::vector<Band>& bands, const Scale& x, double top, double bottom) {
  std::string out;
  for (std::size_t i = 0; i < bands.size(); ++i) {
    out += "<rect class=\"band band" + std::to_string(i % 2) + "\" x=\"" + px(x(bands[i].begin)) + "\" y=\"" + px(top) +
           "\" width=\"" + px(x(bands[i].end) - x(bands[i].begin)) + "\" height=\"" + px(bottom - top) + "\"><title>" +
           escape(bands[i].label) + "</title></rect>\n";
  }
  return out;
}

std::string bandLabels(const std::vector<Band>& bands, const Scale& x, double y) {
  std::string out;
  for (const Band& band : bands) {
    const double width = x(band.end) - x(band.begin);
    // a name that does not fit appears only in the tooltip and the read-out
    if (static_cast<double>(band.label.size()) * kCharacter > width) continue;
    out += textAt(0.5 * (x(band.begin) + x(band.end)), y, "phase", escape(band.label));
  }
  return out;
}

std::string yAxis(const Panel& panel, const Range& range, const Scale& y) {
  std::string out;
  const auto tick = [&](double value, const std::string& label) {
    out += lineFromTo(kLeft, y(value), kRight, y(value), "grid");
    out += textAt(kLeft - 8, y(value) + 4, "tick ytick", label);
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

std::string legend(const Panel& panel, double y) {
  std::string out =
      textAt(kLeft, y, "panel-title", escape(panel.title + (panel.unit.empty() ? "" : " [" + panel.unit + "]")));
  double right = kRight;
  for (auto series = panel.series.rbegin(); series != panel.series.rend(); ++series) {
    right -= static_cast<double>(series->label.size()) * kCharacter;
    out += textAt(right, y, "legend", escape(series->label));
    out += lineFromTo(right - 24, y - 4, right - 6, y - 4, "line " + series->css_class);
    right -= 40;
  }
  return out;
}

std::string path(const std::vector<Point>& points, const Scale& x, const Scale& y, bool step) {
  std::string out;
  const Point* previous = nullptr;
  for (const Point& point : decimate(points, x.data_low, x.data_high, static_cast<int>(x.pixel_high - x.pixel_low))) {
    const std::string at = px(x(point.x));
    if (!previous) {
      out += "M" + at + " " + px(y(point.y));
    } else if (!step) {
      out += "L" + at + " " + px(y(point.y));
    } else if (point.y != previous->y) {
      out += "H" + at + "V" + px(y(point.y));
    }
    previous = &point;
  }
  if (step && previous) out += "H" + px(x(points.back().x));
  return out;
}

std::string linePath(const std::vector<double>& time, const Series& series, const Scale& x, const Scale& y) {
  std::string out;
  std::vector<Point> run;
  const auto flush = [&] {
    if (!run.empty()) out += path(run, x, y, series.step);
    run.clear();
  };
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (std::isfinite(series.y[i])) {
      run.push_back({time[i], series.y[i]});
    } else {
      flush();
    }
  }
  flush();
  return out;
}

std::string panelBody(const TimeFigure& figure, const Panel& panel, const Scale& x, double top) {
  const Range range = yRange(panel);
  const double bottom = top + panel.height;
  const Scale y{range.low, range.high, bottom, top};
  std::string out = legend(panel, top - 9) + bandRects(figure.bands, x, top, bottom) + yAxis(panel, range, y);
  for (const Level& level : panel.levels) {
    out += lineFromTo(kLeft, y(level.value), kRight, y(level.value), "level " + level.css_class);
    out += textAt(kRight - 6, y(level.value) - 5, "level-label", escape(level.label));
  }
  for (const Series& series : panel.series) {
    out += "<path class=\"line " + series.css_class + "\" d=\"" + linePath(figure.time, series, x, y) + "\"/>\n";
  }
  return out + lineFromTo(kLeft, bottom, kRight, bottom, "axis");
}

std::string xAxis(const std::string& label, const Scale& x, double top, double bottom) {
  std::string out;
  const std::vector<double> ticks = niceTicks(x.data_low, x.data_high, 12);
  const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : 0;
  for (const double t : ticks) {
    out += lineFromTo(x(t), top, x(t), bottom, "grid");
    out += textAt(x(t), bottom + 16, "tick xtick", tickText(t, step));
  }
  return out + textAt(0.5 * (kLeft + kRight), bottom + 34, "tick xtick", escape(label));
}

std::string jsonText(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    // "</script>" must not appear inside the data block
    out += c == '<'                               ? std::string("\\u003c")
           : static_cast<unsigned char>(c) < 0x20 ? std::string(" ")
                                                  : std::string(1, c);
  }
  return out + "\"";
}

/// Samples, names and pixel range for the read-out script of the page.
std::string readoutData(const TimeFigure& figure, const Scale& x) {
  const std::size_t stride = std::max<std::size_t>(1, (figure.time.size() + kReadouts - 1) / kReadouts);
  const auto values = [&](const std::vector<double>& all) {
    std::string out = "[";
    for (std::size_t i = 0; i < all.size(); i += stride) {
      if (i > 0) out += ',';
      out += std::isfinite(all[i]) ? number(all[i], 5) : "null";
    }
    return out + "]";
  };
  std::string out = "{\"x0\":" + px(x.pixel_low) + ",\"x1\":" + px(x.pixel_high) + ",\"t0\":" + number(x.data_low, 9) +
                    ",\"t1\":" + number(x.data_high, 9) + ",\"time\":" + values(figure.time) + ",\"bands\":[";
  for (std::size_t i = 0; i < figure.bands.size(); ++i) {
    out += i > 0 ? ",[" : "[";
    out += jsonText(figure.bands[i].label) + "," + number(figure.bands[i].begin, 9) + "," +
           number(figure.bands[i].end, 9) + "]";
  }
  out += "],\"series\":[";
  bool first = true;
  for (const Panel& panel : figure.panels) {
    for (const Series& series : panel.series) {
      out += first ? "{\"label\":" : ",{\"label\":";
      out += jsonText(series.label) + ",\"unit\":" + jsonText(panel.unit) + ",\"cls\":" + jsonText(series.css_class) +
             ",\"y\":" + values(series.y) + ",\"names\":[";
      for (std::size_t i = 0; i < panel.names.size(); ++i) {
        if (i > 0) out += ',';
        out += jsonText(panel.names[i]);
      }
      out += "]}";
      first = false;
    }
  }
  return out + "]}";
}

}  // namespace

std::string render(const TimeFigure& figure) {
  if (figure.time.size() < 2) return "<p class=\"empty\">No samples to plot.</p>\n";
  const Scale x{figure.time.front(), figure.time.back(), kLeft, kRight};
  std::vector<Band> bands = figure.bands;
  for (Band& band : bands) {
    band.begin = std::clamp(band.begin, x.data_low, x.data_high);
    band.end = std::clamp(band.end, x.data_low, x.data_high);
  }
  std::erase_if(bands, [](const Band& band) { return !(band.end > band.begin); });
  TimeFigure shown = figure;
  shown.bands = bands;

  const double first_top = kTop + (bands.empty() ? 0 : 20);
  double bottom = first_top - kGap;
  for (const Panel& panel : figure.panels) bottom += kGap + panel.height;
  const std::string height = px(bottom + kBottom);
  std::string out = "<div class=\"plot\"><svg viewBox=\"0 0 " + px(kWidth) + " " + height +
                    "\" role=\"img\" aria-label=\"" + escape(figure.title) + "\">\n";
  double top = first_top;
  std::string panels;
  for (const Panel& panel : figure.panels) {
    panels += panelBody(shown, panel, x, top);
    top += panel.height + kGap;
  }
  out += bandLabels(bands, x, 12) + panels + xAxis(figure.x_label, x, first_top, bottom);
  out += lineFromTo(kLeft, first_top, kLeft, bottom, "cursor");
  out += "</svg><div class=\"readout\" hidden></div><script type=\"application/json\">" + readoutData(shown, x) +
         "</script></div>\n";
  return out;
}

}  // namespace presa::svg
