#include <algorithm>
#include <cmath>

#include "apps/common/report/svg_time.h"

namespace presa::svg {
namespace {

constexpr std::size_t kReadouts = 1200;  // points that the hover read-out knows
constexpr std::size_t kCsvRows = 1000;   // as many as pixel columns

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

std::string headingOf(const TimeFigure& figure, const Panel& panel, const Series& series) {
  const std::string unit = panel.unit.empty() ? "" : " [" + panel.unit + "]";
  const bool alone = figure.panels.size() == 1 || panel.title.empty();
  return (alone ? "" : panel.title + ": ") + series.label + unit;
}

/// Min and max of a series from sample `begin` to before `end`.
std::pair<double, double> rangeOf(const Series& series, std::size_t begin, std::size_t end) {
  double low = INFINITY, high = -INFINITY;
  for (std::size_t i = begin; i < end; ++i) {
    if (!std::isfinite(series.y[i])) continue;
    low = std::min({low, series.y[i], series.low.empty() ? series.y[i] : series.low[i]});
    high = std::max({high, series.y[i], series.high.empty() ? series.y[i] : series.high[i]});
  }
  return {low, high};
}

/// Every how many samples one is kept, so that there are `most` of them, or the figure's share of it.
std::size_t strideOf(const TimeFigure& figure, std::size_t most) {
  const auto kept = std::max<std::size_t>(1, static_cast<std::size_t>(static_cast<double>(most) * figure.detail));
  return std::max<std::size_t>(1, (figure.time.size() + kept - 1) / kept);
}

}  // namespace

std::string readoutData(const TimeFigure& figure, const Scale& x) {
  const std::size_t stride = strideOf(figure, kReadouts);
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

Csv csvOf(const TimeFigure& figure) {
  const std::size_t count = figure.time.size(), stride = strideOf(figure, kCsvRows);
  const auto asRange = [&](const Series& series) { return stride > 1 || !series.low.empty(); };
  std::vector<std::string> headings{figure.x_label};
  for (const Panel& panel : figure.panels) {
    for (const Series& series : panel.series) {
      const std::string heading = headingOf(figure, panel, series);
      headings.push_back(asRange(series) ? heading + " min" : heading);
      if (asRange(series)) headings.push_back(heading + " max");
    }
  }
  Csv csv(headings);
  for (std::size_t begin = 0; begin < count; begin += stride) {
    std::vector<double> row{figure.time[begin]};
    for (const Panel& panel : figure.panels) {
      for (const Series& series : panel.series) {
        const auto [low, high] = rangeOf(series, begin, std::min(count, begin + stride));
        row.push_back(low);
        if (asRange(series)) row.push_back(high);
      }
    }
    csv.row(row);
  }
  return csv;
}

}  // namespace presa::svg
