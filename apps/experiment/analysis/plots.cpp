#include <algorithm>
#include <cmath>

#include "apps/common/report/svg_facets.h"
#include "apps/common/terminal/text.h"
#include "apps/experiment/analysis/cells.h"
#include "apps/experiment/analysis/section.h"
#include "experiments/runner/statistics/margin.h"
#include "framework/scene/xml/value_rule.h"

namespace presa::experiment::analysis {
namespace {

using svg::FacetFigure;
using svg::FacetPoint;
using svg::Layer;
using Kind = svg::Layer::Kind;
using terminal::format;

double levelValue(const std::string& label) {
  double value = 0;
  return xml::readNumber(label, value) == xml::NumberKind::kFinite ? value : FacetPoint::kNone;
}

/// Distinct levels of the grouping variable at `place`, in the order of the groups.
NameList levelsAt(const std::vector<Group>& groups, std::size_t place) {
  NameList all;
  for (const Group& group : groups) {
    if (std::find(all.begin(), all.end(), group.levels[place]) == all.end()) all.push_back(group.levels[place]);
  }
  return all;
}

std::size_t indexOf(const NameList& levels, const std::string& level) {
  return static_cast<std::size_t>(std::find(levels.begin(), levels.end(), level) - levels.begin());
}

/// Name, level and unit, such as "mass 0.2 kg".
std::string named(const Context& context, const std::string& name, const std::string& level) {
  const std::string unit = context.unitOf(name);
  return name + " " + level + (unit.empty() ? "" : " " + unit);
}
NameList named(const Context& context, const std::string& name, const NameList& levels) {
  NameList all;
  for (const std::string& level : levels) all.push_back(named(context, name, level));
  return all;
}

std::string labelOf(const Context& context, const NameList& names, const Group& group) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i > 0 ? ", " : "") + named(context, names[i], group.levels[i]);
  return text;
}

void addColorLegend(const Context& context, const std::string& name, const NameList& levels, Kind kind,
                    FacetFigure& figure) {
  for (std::size_t i = 0; i < levels.size(); ++i)
    figure.legend.push_back({named(context, name, levels[i]), kind, static_cast<int>(i)});
}

/// Axis ticks at the levels when there are at most 8; otherwise empty, for ticks at round numbers.
std::vector<double> ticksAt(const Trials& trials, const std::string& name, const std::vector<std::size_t>& rows) {
  std::vector<double> values = trials.numbersOf(name, rows);
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values.size() <= 8 ? values : std::vector<double>{};
}

std::string valueText(const Context& context, const std::string& y, double mean, std::size_t n) {
  const std::string unit = context.unitOf(y);
  return format("%s %.3g%s%s, n %zu", y.c_str(), mean, unit.empty() ? "" : " ", unit.c_str(), n);
}

}  // namespace

Section section(const wanted::Bars& what, const Context& context) {
  Section section{"bars", "Mean " + what.y, "mean of the trials of each cell"};
  const NameList by{what.rows, what.columns, what.color};
  const CellMeansOf means = cellMeans(context, what.y, by);
  std::vector<Group> groups;
  for (const auto& cell : means.cells) groups.push_back(cell.group);
  const NameList rows = levelsAt(groups, 0), columns = levelsAt(groups, 1), colors = levelsAt(groups, 2);
  FacetFigure figure{"Mean of " + what.y,
                     context.heading(what.color),
                     context.heading(what.y),
                     named(context, what.columns, columns),
                     named(context, what.rows, rows),
                     std::vector<svg::Facet>(rows.size() * columns.size())};
  figure.x_names = colors;
  for (const auto& cell : means.cells) {
    const std::size_t facet =
        indexOf(rows, cell.group.levels[0]) * columns.size() + indexOf(columns, cell.group.levels[1]);
    const std::size_t color = indexOf(colors, cell.group.levels[2]);
    FacetPoint bar{static_cast<double>(color), cell.mean};
    bar.label = labelOf(context, by, cell.group) + "\n" + valueText(context, what.y, cell.mean, cell.group.rows.size());
    figure.facets[facet].layers.push_back({Kind::kBars, static_cast<int>(color), false, {bar}});
  }
  addColorLegend(context, what.color, colors, Kind::kBars, figure);
  section.figure = svg::render(figure);
  noteIncomplete(context, {what.y}, section);
  return section;
}

Section section(const wanted::MeansPlot& what, const Context& context) {
  Section section{"means", what.y + " over " + what.x, ""};
  const NameList by{what.rows, what.columns, what.x};
  const CellMeansOf means = cellMeans(context, what.y, by);
  const bool within = what.within_subject && means.correction;
  section.method = within ? "means of the trials; bars: " + context.percent() +
                                " within-subject interval (Cousineau 2005, Morey 2008)"
                          : "means of the trials; bars: " + context.percent() + " t interval of the trials of a cell";
  if (what.within_subject && !within)
    section.notes.emplace_back(
        "Drawn is the interval of the trials: one within subjects takes two of them, each with every cell.");
  std::vector<Group> groups;
  for (const auto& cell : means.cells) groups.push_back(cell.group);
  const NameList rows = levelsAt(groups, 0), columns = levelsAt(groups, 1);
  FacetFigure figure{what.y + " over " + what.x,      context.heading(what.x),
                     context.heading(what.y),         named(context, what.columns, columns),
                     named(context, what.rows, rows), std::vector<svg::Facet>(rows.size() * columns.size())};
  figure.x_ticks = ticksAt(context.trials, what.x, context.trials.complete({what.y, what.x}));
  for (svg::Facet& facet : figure.facets) facet.layers = {{Kind::kLine, -1, true, {}}, {Kind::kJoined, 1, false, {}}};
  for (const auto& cell : means.cells) {
    svg::Facet& facet =
        figure.facets[indexOf(rows, cell.group.levels[0]) * columns.size() + indexOf(columns, cell.group.levels[1])];
    FacetPoint point{levelValue(cell.group.levels[2]), cell.mean};
    if (const auto& interval = within ? cell.within_subject : cell.over_trials)
      point.low = interval->low, point.high = interval->high;
    point.label =
        labelOf(context, by, cell.group) + "\n" + valueText(context, what.y, cell.mean, cell.group.rows.size());
    facet.layers[1].points.push_back(point);
    if (what.line.empty()) continue;
    if (const auto line = statistics::mean(context.trials.numbersOf(what.line, cell.group.rows)))
      facet.layers[0].points.push_back({point.x, *line});
  }
  figure.legend.push_back({"mean " + what.y, Kind::kJoined, 1});
  if (!what.line.empty()) figure.legend.push_back({what.line, Kind::kLine, -1, true});
  section.figure = svg::render(figure);
  noteIncomplete(context, {what.y}, section);
  return section;
}

Section section(const wanted::MarginPlot& what, const Context& context) {
  Section section{"margins", "Relative safety margin over " + what.x,
                  "median over the trials of 100 (grip - slip) / grip, one line for each combination of " + what.color +
                      " and " + what.shape};
  const Trials& trials = context.trials;
  const NameList by{what.color, what.shape, what.x};
  const std::vector<Group> groups =
      groupsBy(context.experiment, trials, by, trials.complete({what.grip, what.slip, what.x}));
  const NameList colors = levelsAt(groups, 0), shapes = levelsAt(groups, 1);
  FacetFigure figure{"Relative safety margin",
                     context.heading(what.x) + (what.log_x ? ", logarithmic" : ""),
                     "margin [% of the grip force]",
                     named(context, what.shape, shapes),
                     {""},
                     std::vector<svg::Facet>(shapes.size())};
  figure.x_ticks = ticksAt(trials, what.x, trials.complete({what.x}));
  figure.x_log = what.log_x;
  Table table{"margins_" + what.grip, {}, {}, true};
  for (const std::string& name : by) table.columns.push_back({name, context.unitOf(name)});
  table.columns.insert(table.columns.end(), {{"n", "", "%.0f"}, {"margin_median", "%", "%.1f"}});
  for (svg::Facet& facet : figure.facets) {
    for (std::size_t c = 0; c < colors.size(); ++c)
      facet.layers.push_back({Kind::kJoined, static_cast<int>(c), false, {}});
  }
  for (const Group& group : groups) {
    std::vector<double> margins;
    for (const std::size_t row : group.rows) {
      if (const auto margin =
              statistics::relativeSafetyMargin(trials.numbers.at(what.grip)[row], trials.numbers.at(what.slip)[row]))
        margins.push_back(*margin);
    }
    const auto median = statistics::median(margins);
    if (!median) continue;
    FacetPoint point{levelValue(group.levels[2]), *median};
    point.label = labelOf(context, by, group) + format("\nmargin %.1f %%, n %zu", *median, margins.size());
    figure.facets[indexOf(shapes, group.levels[1])].layers[indexOf(colors, group.levels[0])].points.push_back(point);
    std::vector<Cell> cells(group.levels.begin(), group.levels.end());
    cells.emplace_back(static_cast<double>(margins.size()));
    cells.emplace_back(*median);
    table.rows.push_back(std::move(cells));
  }
  addColorLegend(context, what.color, colors, Kind::kJoined, figure);
  section.figure = svg::render(figure);
  section.tables.push_back(std::move(table));
  noteIncomplete(context, {what.grip, what.slip, what.x}, section);
  return section;
}

Section section(const wanted::Scatter& what, const Context& context) {
  Section section{"scatter", what.y + " over " + what.x, "one symbol per trial"};
  const Trials& trials = context.trials;
  const std::vector<std::size_t> rows = trials.complete({what.x, what.y});
  FacetFigure figure{what.y + " over " + what.x, context.heading(what.x), context.heading(what.y)};
  figure.x_from_zero = true;
  figure.facets.resize(1);
  double max = 0;
  for (const std::size_t row : rows) max = std::max(max, trials.numbers.at(what.x)[row]);
  if (what.diagonal) figure.facets[0].layers.push_back({Kind::kLine, -1, true, {{0, 0}, {max, max}}});
  const std::vector<Group> groups = groupsBy(context.experiment, trials, {what.color}, rows);
  std::size_t under = 0;
  for (const Group& group : groups) {
    Layer layer{Kind::kSymbols, static_cast<int>(figure.facets[0].layers.size() - (what.diagonal ? 1 : 0)), false, {}};
    for (const std::size_t row : group.rows) {
      FacetPoint point{trials.numbers.at(what.x)[row], trials.numbers.at(what.y)[row]};
      under += point.y < point.x ? 1 : 0;
      if (rows.size() <= 2000)
        point.label =
            format("%s, trial %d, ", trials.subjects[trials.rows[row].subject].c_str(), trials.rows[row].number) +
            named(context, what.color, group.levels[0]) +
            format("\n%s %.3g, %s %.3g", what.x.c_str(), point.x, what.y.c_str(), point.y);
      layer.points.push_back(std::move(point));
    }
    layer.shift = 9 * (layer.color - 0.5 * static_cast<double>(groups.size() - 1));
    figure.facets[0].layers.push_back(std::move(layer));
  }
  if (groups.size() > 1) section.method += "; the groups are drawn side by side";
  addColorLegend(context, what.color, levelsAt(groups, 0), Kind::kSymbols, figure);
  if (what.diagonal) {
    figure.legend.push_back({what.y + " = " + what.x, Kind::kLine, -1, true});
    section.figure_caption = format("%zu of %zu trials lie under the line.", under, rows.size());
  }
  section.figure = svg::render(figure);
  noteIncomplete(context, {what.x, what.y}, section);
  return section;
}

}  // namespace presa::experiment::analysis
