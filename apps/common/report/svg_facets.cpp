#include "apps/common/report/svg_facets.h"

#include <algorithm>
#include <cmath>

#include "apps/common/report/svg_plot.h"
#include "apps/common/report/svg_range.h"
#include "apps/common/report/svg_save.h"
#include "apps/common/report/svg_scale.h"
#include "apps/common/report/svg_symbols.h"

namespace presa::svg {
namespace {

using Kind = Layer::Kind;

constexpr double kLeft = 66, kRight = 14, kLegend = 26, kHead = 20, kAxis = 44, kGap = 14;  // margins [px]
constexpr double kCharacter = 6.6;  // mean width of the labels' font

/// Scales and layout that all facets share.
struct Axes {
  Range x, y;
  std::vector<double> x_ticks, y_ticks;
};

/// Widens one range so that a unit has the same length on both axes.
void equalise(Range& x, Range& y, double width, double height) {
  const double unit = std::max((x.high - x.low) / width, (y.high - y.low) / height);
  const auto widen = [](Range& range, double to) {
    const double more = 0.5 * (to - (range.high - range.low));
    range = {range.low - more, range.high + more};
  };
  widen(x, unit * width), widen(y, unit * height);
}

Axes axesOf(const FacetFigure& figure, double width, double height) {
  Axes axes;
  for (const Facet& facet : figure.facets) {
    for (const Layer& layer : facet.layers) {
      for (const FacetPoint& point : layer.points) {
        for (const double x : {point.x, point.left, point.right}) axes.x.add(x);
        for (const double y : {point.y, point.low, point.high}) axes.y.add(y);
      }
    }
  }
  if (figure.y_from_zero) axes.y.add(0);
  if (figure.x_from_zero) axes.x.add(0);
  axes.y.add(figure.y_max);
  if (!(axes.x.low <= axes.x.high)) axes.x = {0, 1};
  if (!(axes.y.low <= axes.y.high)) axes.y = {0, 1};
  const Range wide = axes.y.widened(0.06);
  axes.y = {figure.y_from_zero && axes.y.low >= 0 ? 0 : wide.low, wide.high};
  if (!figure.x_names.empty())
    axes.x = {-0.6, static_cast<double>(figure.x_names.size()) - 0.4};
  else if (figure.x_from_zero && axes.x.low >= 0)
    axes.x = {0, axes.x.widened(0.05).high};
  else
    axes.x = axes.x.widened(0.1);
  if (figure.equal_scales) equalise(axes.x, axes.y, width, height);
  axes.y_ticks = niceTicks(axes.y.low, axes.y.high, static_cast<int>(std::max(3.0, height / 45)));
  axes.x_ticks = figure.x_ticks;
  for (std::size_t i = 0; i < figure.x_names.size(); ++i) axes.x_ticks.push_back(static_cast<double>(i));
  if (axes.x_ticks.empty()) axes.x_ticks = niceTicks(axes.x.low, axes.x.high, 7);
  return axes;
}

std::string symbolAt(double x, double y, double size, int color, const std::string& label) {
  const std::string data =
      label.empty() ? "/>\n" : " data-name=\"" + escape(label) + "\"><title>" + escape(label) + "</title></path>\n";
  return "<path class=\"symbol " + colorClass(color) + "\" d=\"" + symbolPath(x, y, 4 * size, std::max(color, 0)) +
         "\"" + data;
}

std::string errorBars(const FacetPoint& point, const Scale& x, const Scale& y) {
  std::string out;
  const double px_x = x(point.x), px_y = y(point.y), cap = 3;
  if (std::isfinite(point.low) && std::isfinite(point.high)) {
    const double low = y(point.low), high = y(point.high);
    out += "<path class=\"error\" d=\"M" + px(px_x) + " " + px(low) + "V" + px(high) + "M" + px(px_x - cap) + " " +
           px(low) + "h" + px(2 * cap) + "M" + px(px_x - cap) + " " + px(high) + "h" + px(2 * cap) + "\"/>\n";
  }
  if (std::isfinite(point.left) && std::isfinite(point.right)) {
    const double left = x(point.left), right = x(point.right);
    out += "<path class=\"error\" d=\"M" + px(left) + " " + px(px_y) + "H" + px(right) + "M" + px(left) + " " +
           px(px_y - cap) + "v" + px(2 * cap) + "M" + px(right) + " " + px(px_y - cap) + "v" + px(2 * cap) + "\"/>\n";
  }
  return out;
}

std::string polyline(const std::vector<FacetPoint>& points, const Scale& x, const Scale& y) {
  std::string d;
  for (const FacetPoint& point : points) d += (d.empty() ? "M" : "L") + px(x(point.x)) + " " + px(y(point.y));
  return d;
}

std::string barsOf(const Layer& layer, const Scale& x, const Scale& y) {
  std::string out;
  const double width = 0.8 * std::abs(x(1) - x(0));
  for (const FacetPoint& point : layer.points) {
    const double top = std::min(y(point.y), y(0)), height = std::abs(y(point.y) - y(0));
    out += "<rect class=\"bar " + colorClass(layer.color) + "\" x=\"" + px(x(point.x) - 0.5 * width) + "\" y=\"" +
           px(top) + "\" width=\"" + px(width) + "\" height=\"" + px(height) + "\" data-name=\"" + escape(point.label) +
           "\"><title>" + escape(point.label) + "</title></rect>\n" + errorBars(point, x, y);
  }
  return out;
}

std::string areaOf(const Layer& layer, const Scale& x, const Scale& y) {
  std::string d;
  const auto add = [&](double at_x, double at_y) { d += (d.empty() ? "M" : "L") + px(x(at_x)) + " " + px(y(at_y)); };
  const auto sideways = [](const FacetPoint& point) { return std::isfinite(point.left); };
  for (const FacetPoint& p : layer.points) sideways(p) ? add(p.left, p.y) : add(p.x, p.high);
  for (auto p = layer.points.rbegin(); p != layer.points.rend(); ++p)
    sideways(*p) ? add(p->right, p->y) : add(p->x, p->low);
  return d.empty() ? d : "<path class=\"area " + colorClass(layer.color) + "\" d=\"" + d + "z\"/>\n";
}

std::string layerOf(const Layer& layer, const Scale& x, const Scale& y) {
  if (layer.kind == Kind::kBars) return barsOf(layer, x, y);
  if (layer.kind == Kind::kArea) return areaOf(layer, x, y);
  std::string out;
  if (layer.kind != Kind::kSymbols)
    out += "<path class=\"line " + colorClass(layer.color) + (layer.dashed ? " dashed" : "") + "\" d=\"" +
           polyline(layer.points, x, y) + "\"/>\n";
  if (layer.kind == Kind::kLine) return out;
  for (const FacetPoint& point : layer.points)
    out +=
        errorBars(point, x, y) + symbolAt(x(point.x) + layer.shift, y(point.y), point.size, layer.color, point.label);
  return out;
}

std::string legendOf(const FacetFigure& figure) {
  std::string out;
  double at = kLeft;
  for (const FacetFigure::Entry& entry : figure.legend) {
    const double y = 12;
    if (entry.kind == Kind::kBars || entry.kind == Kind::kArea)
      out += "<rect class=\"" + std::string(entry.kind == Kind::kBars ? "bar " : "area ") + colorClass(entry.color) +
             "\" x=\"" + px(at) + "\" y=\"" + px(y - 6) + "\" width=\"16\" height=\"12\"/>\n";
    if (entry.kind == Kind::kLine || entry.kind == Kind::kJoined)
      out += "<path class=\"line " + colorClass(entry.color) + (entry.dashed ? " dashed" : "") + "\" d=\"M" + px(at) +
             " " + px(y) + "h18\"/>\n";
    if (entry.kind == Kind::kSymbols || entry.kind == Kind::kJoined) out += symbolAt(at + 9, y, 1, entry.color, "");
    out += textAt(at + 24, y + 4, "", escape(entry.label));
    at += 24 + kCharacter * static_cast<double>(entry.label.size()) + 26;
  }
  return out;
}

/// One facet with its frame, and with ticks if it is at an edge of the figure.
std::string facetAt(const FacetFigure& figure, const Axes& axes, std::size_t row, std::size_t column, const Scale& x,
                    const Scale& y) {
  std::string out;
  const double left = x.pixel_low, right = x.pixel_high, bottom = y.pixel_low, top = y.pixel_high;
  const double y_step = axes.y_ticks.size() > 1 ? axes.y_ticks[1] - axes.y_ticks[0] : 0;
  for (const double value : axes.y_ticks) {
    out += lineFromTo(left, y(value), right, y(value), "grid");
    if (column == 0) out += textAt(left - 8, y(value) + 4, "tick ytick", tickText(value, y_step));
  }
  const bool last = row + 1 == figure.rows.size();
  const double x_step = axes.x_ticks.size() > 1 ? axes.x_ticks[1] - axes.x_ticks[0] : 0;
  for (std::size_t i = 0; i < axes.x_ticks.size(); ++i) {
    const double value = axes.x_ticks[i];
    if (figure.x_names.empty()) out += lineFromTo(x(value), top, x(value), bottom, "grid");
    if (!last) continue;
    const std::string text = !figure.x_names.empty()   ? escape(figure.x_names[i])
                             : figure.x_log            ? number(std::pow(10, value), 4)
                             : !figure.x_ticks.empty() ? number(value, 4)
                                                       : tickText(value, x_step);
    out += textAt(x(value), bottom + 16, "tick xtick", text);
  }
  const std::size_t index = row * figure.columns.size() + column;
  if (index < figure.facets.size()) {
    for (const Layer& layer : figure.facets[index].layers) out += layerOf(layer, x, y);
  }
  const double zero = std::clamp(y(0), top, bottom);
  out += lineFromTo(left, bottom, right, bottom, "axis") + lineFromTo(left, top, left, bottom, "axis");
  if (zero < bottom - 1 && zero > top) out += lineFromTo(left, zero, right, zero, "axis");
  if (row == 0 && !figure.columns[column].empty())
    out += textAt(0.5 * (left + right), top - 7, "phase", escape(figure.columns[column]));
  if (column + 1 == figure.columns.size() && !figure.rows[row].empty())
    out += "<text class=\"phase\" transform=\"translate(" + px(right + 14) + " " + px(0.5 * (top + bottom)) +
           ") rotate(90)\">" + escape(figure.rows[row]) + "</text>\n";
  return out;
}

/// The figure with the logarithms of its x in their place.
FacetFigure withLogOfX(FacetFigure figure) {
  for (Facet& facet : figure.facets) {
    for (Layer& layer : facet.layers) {
      std::erase_if(layer.points, [](const FacetPoint& point) { return !(point.x > 0); });
      for (FacetPoint& point : layer.points) {
        for (double* x : {&point.x, &point.left, &point.right}) *x = std::log10(*x);
      }
    }
  }
  std::erase_if(figure.x_ticks, [](double tick) { return !(tick > 0); });
  for (double& tick : figure.x_ticks) tick = std::log10(tick);
  return figure;
}

Csv csvOf(const FacetFigure& figure) {
  Csv csv({"where", figure.x_label, figure.y_label, "low", "high", "x low", "x high"});
  for (std::size_t i = 0; i < figure.facets.size(); ++i) {
    const std::string& row = figure.rows[i / figure.columns.size()];
    const std::string& column = figure.columns[i % figure.columns.size()];
    for (const Layer& layer : figure.facets[i].layers) {
      for (const FacetPoint& p : layer.points) {
        const std::string where = row + (row.empty() || column.empty() ? "" : ", ") + column;
        csv.row(p.label.empty() ? where : where + (where.empty() ? "" : ": ") + p.label,
                {p.x, p.y, p.low, p.high, p.left, p.right});
      }
    }
  }
  return csv;
}

}  // namespace

std::string render(const FacetFigure& asked) {
  const FacetFigure figure = asked.x_log ? withLogOfX(asked) : asked;
  const bool single = figure.columns.size() * figure.rows.size() == 1;
  const double width = single ? 760 : 1080;                                                  // of the figure
  const double height = figure.facet_height > 0 ? figure.facet_height : single ? 360 : 148;  // of one facet
  const double right = kRight + (figure.rows.front().empty() ? 0 : 16);
  const double columns = static_cast<double>(figure.columns.size()), rows = static_cast<double>(figure.rows.size());
  const double facet_width = (width - kLeft - right - (columns - 1) * kGap) / columns;
  const double first_top = kLegend + (figure.columns.front().empty() ? 4 : kHead);
  const double bottom = first_top + rows * height + (rows - 1) * kGap;
  const Axes axes = axesOf(figure, facet_width, height);
  std::string out = "<svg viewBox=\"0 0 " + px(width) + " " + px(bottom + kAxis) + "\" role=\"img\" aria-label=\"" +
                    escape(figure.title) + "\">\n" + legendOf(figure);
  for (std::size_t row = 0; row < figure.rows.size(); ++row) {
    for (std::size_t column = 0; column < figure.columns.size(); ++column) {
      const double left = kLeft + static_cast<double>(column) * (facet_width + kGap);
      const double top = first_top + static_cast<double>(row) * (height + kGap);
      out += facetAt(figure, axes, row, column, {axes.x.low, axes.x.high, left, left + facet_width},
                     {axes.y.low, axes.y.high, top + height, top});
    }
  }
  out += textAt(0.5 * (kLeft + width - right), bottom + 36, "tick xtick", escape(figure.x_label));
  out += "<text class=\"tick xtick\" transform=\"translate(14 " + px(0.5 * (first_top + bottom)) + ") rotate(-90)\">" +
         escape(figure.y_label) + "</text>\n</svg>";
  return withSaveLinks(single ? "plot single" : "plot", out, "<div class=\"readout\" hidden></div>", figure.title,
                       csvOf(asked));
}

}  // namespace presa::svg
