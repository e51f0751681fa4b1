#include "apps/common/report/page.h"

#include "apps/common/report/contours.h"
#include "apps/common/report/html.h"
#include "apps/common/report/svg_facets.h"
#include "apps/common/terminal/text.h"
#include "apps/common/version.h"
#include "apps/presa/device/characterise.h"

namespace presa::device {
namespace {

using svg::escape;
using Kind = svg::Layer::Kind;

svg::Layer layerOf(const PlotLine& line) {
  svg::Layer layer{line.symbols ? Kind::kSymbols : Kind::kLine, line.color, line.dashed};
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    layer.points.push_back({line.x[i], line.y[i]});
    if (line.symbols) layer.points.back().label = line.label + ": " + numberText(line.y[i]);
  }
  return layer;
}

void addContours(const PlotMap& map, svg::Facet& facet) {
  for (std::size_t i = 0; i < map.levels.size(); ++i) {
    for (const auto& line : svg::contours(map.x, map.y, map.z, map.levels[i])) {
      svg::Layer layer{Kind::kLine, static_cast<int>(i)};
      for (const svg::Point& point : line) layer.points.push_back({point.x, point.y});
      facet.layers.push_back(std::move(layer));
    }
  }
}

void addLegend(const PlotPanel& panel, bool first, svg::FacetFigure& figure) {
  for (const PlotLine& line : panel.lines) {
    if (!line.label.empty())
      figure.legend.push_back({line.label, line.symbols ? Kind::kSymbols : Kind::kLine, line.color, line.dashed});
  }
  if (!first || !panel.map) return;
  for (std::size_t i = 0; i < panel.map->levels.size(); ++i)
    figure.legend.push_back({terminal::format("%g", panel.map->levels[i]), Kind::kLine, static_cast<int>(i), false});
}

svg::FacetFigure figureOf(const DevicePlot& plot) {
  svg::FacetFigure figure{.title = plot.title, .x_label = plot.x_label, .y_label = plot.y_label};
  figure.columns.clear();
  figure.y_from_zero = plot.y_from_zero;
  figure.equal_scales = plot.equal_scales;
  if (plot.equal_scales) figure.facet_height = 480;
  for (const PlotPanel& panel : plot.panels) {
    addLegend(panel, figure.facets.empty(), figure);
    svg::Facet facet;
    if (panel.map) addContours(*panel.map, facet);
    for (const PlotLine& line : panel.lines) facet.layers.push_back(layerOf(line));
    figure.columns.push_back(panel.title);
    figure.facets.push_back(std::move(facet));
  }
  return figure;
}

std::string cell(const std::string& text, const std::string& css = {}) {
  return "<td class=\"" + css + "\">" + escape(text) + "</td>";
}

std::string figureTable(const Characterisation& c) {
  std::string rows;
  for (const Characteristic& f : c.figures) {
    const std::string unit = f.unit == "1" ? "" : " " + f.unit;
    rows += "<tr>";
    rows += cell(f.name, "words");
    rows += cell(f.compared() ? printedText(f) + unit : "–");
    rows += cell(numberText(f.here) + unit);
    rows += cell(verdictText(f), !f.compared() ? "words" : f.agrees() ? "words good" : "words bad");
    rows += cell(f.note, "words");
    rows += "</tr>\n";
  }
  return html::table({"figure", "printed", "here", "", "where, and how"}, rows);
}

std::string assumptionTable(const Characterisation& c) {
  std::string rows;
  for (const Assumption& a : c.assumptions) {
    rows += "<tr>";
    rows += cell(a.name, "words");
    rows += cell(terminal::format("%.4g", a.value) + (a.unit == "1" ? "" : " " + a.unit));
    rows += cell(a.origin, "words");
    rows += "</tr>\n";
  }
  return html::table({"number", "value", "where from"}, rows);
}

}  // namespace

std::string page(const Characterisation& c) {
  std::string out = page::head(c.title + " – Presa") + "<h1>" + escape(c.title) + "</h1>\n<p class=\"lead\">Beside " +
                    escape(c.source) + ". These are figures of the model, not of a device.</p>\n" + figureTable(c) +
                    "<p class=\"caption\">Fitted: the model was made from this figure. Follows: the model predicts it. "
                    "Assumed: it rests on unpublished numbers.</p>\n";
  for (const DevicePlot& plot : c.plots)
    out += "<h2>" + escape(plot.title) + "</h2>\n" + svg::render(figureOf(plot)) + "<p class=\"caption\">" +
           escape(plot.caption) + "</p>\n";
  return out + "<h2>Unpublished numbers</h2>\n" + assumptionTable(c) + "<p class=\"caption\">Presa " +
         escape(versionText()) + "</p>\n" + page::tail();
}

}  // namespace presa::device
