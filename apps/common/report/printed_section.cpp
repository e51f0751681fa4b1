#include "apps/common/report/printed_section.h"

#include "apps/common/report/html.h"
#include "apps/common/report/svg_plot.h"
#include "apps/common/summary.h"

namespace presa::html {
namespace {

using svg::escape;

/// `text` of each figure that has one, as a list; `printed`: with what the source has.
std::string sentencesOf(const Printed& printed, std::string PrintedFigure::*text, bool with_print) {
  std::string items;
  for (const PrintedFigure& figure : printed.figures) {
    if ((figure.*text).empty()) continue;
    std::string print = with_print ? "; printed: " + figure.printed : "";
    if (with_print && !figure.unit.empty()) print += " " + figure.unit;
    items += "<li><b>" + escape(figure.what) + "</b> (" + escape(figure.where + print) + "). " + escape(figure.*text) +
             "</li>\n";
  }
  return items.empty() ? items : "<ul>\n" + items + "</ul>\n";
}

}  // namespace

std::string printedTable(const Printed& printed, const std::vector<SummaryColumn>& runs) {
  std::vector<std::string> head{"figure", "in", "printed"};
  for (const SummaryColumn& run : runs) head.push_back(escape(run.first));
  head.emplace_back("unit");
  std::string rows;
  for (const PrintedFigure& figure : printed.figures) {
    if (figure.measure.empty()) continue;
    std::vector<std::string> cells{escape(figure.what), escape(figure.where), escape(figure.printed)};
    for (const SummaryColumn& run : runs) cells.push_back(escape(measuredText(figure, run.second)));
    cells.push_back(escape(figure.unit));
    rows += row(cells);
  }
  const std::string wrong = sentencesOf(printed, &PrintedFigure::wrong, true);
  return table(head, rows) + "<p class=\"caption\">" + escape(printed.source) +
         ". A dash: not printed, or not shown by this run.</p>\n" + sentencesOf(printed, &PrintedFigure::note, false) +
         (wrong.empty() ? wrong : "<h3>Where the print is wrong</h3>\n" + wrong);
}

std::string printedSection(const RunResult& result) {
  Diagnostics diagnostics;
  const auto printed = printedOf(result.world->scene.file, diagnostics);
  const std::string heading = "<h2>Printed and measured</h2>\n";
  if (diagnostics.hasErrors()) return heading + "<pre class=\"fault\">" + escape(diagnostics.text()) + "</pre>\n";
  if (!printed) return {};
  return heading + printedTable(*printed, {{"this run", nlohmann::json::parse(summaryJson(result))}});
}

}  // namespace presa::html
