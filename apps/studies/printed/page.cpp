#include "apps/studies/printed/page.h"

#include <algorithm>
#include <cmath>

#include "apps/common/delimited.h"
#include "apps/common/number_text.h"
#include "apps/common/report/html.h"
#include "apps/common/report/page.h"
#include "apps/common/report/printed_section.h"
#include "apps/common/report/svg_plot.h"
#include "apps/common/terminal/text.h"
#include "apps/common/version.h"

namespace presa::printed {
namespace {

using svg::escape;
using terminal::format;
using Texts = std::vector<std::string>;
using Rows = std::vector<Texts>;  // the first one is the head

constexpr const char* kPrintedName = "as printed";
constexpr const char* kTodayName = "today";

std::string orDash(double value, int decimals) { return std::isnan(value) ? "–" : fixed(value, decimals); }

Texts gridHead(const Comparison& comparison) {
  Texts head;
  for (const PrintedValues& axis : comparison.print.vary) head.push_back(axis.name + " [" + axis.unit + "]");
  const Texts figures{"natural [Hz]", "min mass [g]", "methods",      "held",      "ripple [%]",
                      "mismatch [%]", "slip at [N]",  "known to [N]", "limit [N]", "offset [mm]"};
  head.insert(head.end(), figures.begin(), figures.end());
  return head;
}

Texts gridRow(const Cell& cell, const Grasp& grasp, const char* methods) {
  Texts row;
  for (const double value : cell.values) row.push_back(significant(value, 4));
  const Grasp& known = std::isnan(grasp.frequency) ? cell.today : grasp;
  const Texts figures{orDash(known.frequency, 1), orDash(1000 * known.min_mass, 1), methods,
                      grasp.held ? "yes" : "no",  orDash(100 * grasp.ripple, 3),    orDash(100 * grasp.mismatch, 1),
                      orDash(grasp.slip, 3),      orDash(grasp.slip_known_to, 3),   orDash(known.slip_limit, 3),
                      orDash(grasp.offset, 3)};
  row.insert(row.end(), figures.begin(), figures.end());
  return row;
}

Rows gridRows(const Comparison& comparison) {
  Rows rows{gridHead(comparison)};
  for (const Cell& cell : comparison.cells) {
    rows.push_back(gridRow(cell, cell.printed, kPrintedName));
    rows.push_back(gridRow(cell, cell.today, kTodayName));
  }
  return rows;
}

Rows aloneRows(const Comparison& comparison) {
  const auto& lost = comparison.print.until_lost;
  Rows rows{{"one method of today, the others as printed", "ripple [%]", "mismatch [%]", "offset [mm]"}};
  if (lost) rows[0].push_back("held down to [" + lost->unit + "]");
  for (const Alone& alone : comparison.alone) {
    rows.push_back({alone.set, orDash(100 * alone.grasp.ripple, 3), orDash(100 * alone.grasp.mismatch, 1),
                    orDash(alone.grasp.offset, 3)});
    if (lost) rows.back().push_back(alone.lasting ? significant(*alone.lasting, 4) : "–");
  }
  return rows;
}

Rows figureRows(const Comparison& comparison) {
  Rows rows{{"figure", "in", "printed", kPrintedName, kTodayName, "unit"}};
  for (const PrintedFigure& figure : comparison.print.figures) {
    if (figure.measure.empty()) continue;
    rows.push_back({figure.what, figure.where, figure.printed, measuredText(figure, comparison.printed),
                    measuredText(figure, comparison.today), figure.unit});
  }
  return rows;
}

std::string aligned(const Rows& rows) {
  std::vector<std::size_t> widths(rows[0].size());
  for (const Texts& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], terminal::widthOf(row[i]));
  }
  std::string out;
  for (const Texts& row : rows) {
    for (std::size_t i = 0; i + 1 < row.size(); ++i)
      out += row[i] + std::string(widths[i] + 2 - terminal::widthOf(row[i]), ' ');
    out += row.back() + '\n';
  }
  return out;
}

std::string htmlTable(const Rows& rows) {
  Texts head;
  std::string body;
  for (const Texts& row : rows) {
    Texts cells;
    for (const std::string& text : row) cells.push_back(escape(text));
    if (head.empty()) {
      head = cells;
    } else {
      body += html::row(cells);
    }
  }
  return html::table(head, body);
}

svg::WorkFigure mismatchFigure(const Comparison& comparison) {
  svg::WorkFigure figure;
  figure.title = "Impulse on the user against that on the object";
  figure.x_label = "natural frequency of the grasp [Hz]";
  figure.y_label = "largest difference in any 0.1 s [%]";
  for (const bool today : {false, true}) {
    const char* name = today ? kTodayName : kPrintedName;
    const int color = today ? 1 : 0;
    figure.entries.push_back({name, color, color});
    for (const Cell& cell : comparison.cells) {
      const Grasp& grasp = today ? cell.today : cell.printed;
      if (std::isnan(grasp.mismatch) || std::isnan(grasp.frequency)) continue;
      svg::WorkPoint point{{grasp.frequency, 100 * grasp.mismatch}, grasp.frequency, grasp.frequency, name, "other"};
      for (std::size_t i = 0; i < cell.values.size(); ++i)
        point.label += ", " + significant(cell.values[i], 4) + " " + comparison.print.vary[i].unit;
      point.label += format(": %.2g %%", 100 * grasp.mismatch);
      point.color = point.shape = color;
      figure.points.push_back(point);
    }
  }
  return figure;
}

constexpr const char* kGridCaption =
    "Of both fingers the worse. Min mass: n K h² / 4, what n fingers of stiffness K need with an explicit exchange of "
    "forces every h. Held: in stick for all of the hold. Ripple: of the grip, peak to peak over its mean. Mismatch: of "
    "the "
    "impulses on user and object, largest in any 0.1 s. Slip at: grip at which the object slips, known to the fall of "
    "the "
    "grip in one step of the dynamics; limit: m g / (n μₛ). Offset: range of the difference between finger and object "
    "in "
    "the hold.";

}  // namespace

std::string terminalText(const Comparison& comparison) {
  std::string out = aligned(figureRows(comparison));
  if (!comparison.cells.empty()) out += '\n' + aligned(gridRows(comparison));
  if (!comparison.alone.empty()) out += '\n' + aligned(aloneRows(comparison));
  return out;
}

std::string reportHtml(const Comparison& comparison, const std::string& command) {
  const std::string scene = escape(comparison.scene);
  std::string out = page::head("As printed, and today – Presa") + "<h1>As printed, and today</h1>\n" +
                    "<p class=\"lead\">The system of <code>" + scene +
                    "</code> as its paper prints it, beside the same scene and hands with the methods of today.</p>\n" +
                    "<div class=\"verdict " + (comparison.holds() ? "good" : "bad") + "\">\n";
  for (const std::string& sentence : comparison.sentences()) out += "<p>" + escape(sentence) + "</p>\n";
  out += "</div>\n<h2>Printed and measured</h2>\n" +
         html::printedTable(comparison.print, {{kPrintedName, comparison.printed}, {kTodayName, comparison.today}});
  if (!comparison.cells.empty())
    out += "<h2>The grid</h2>\n" + svg::render(mismatchFigure(comparison)) + htmlTable(gridRows(comparison)) +
           "<p class=\"caption\">" + kGridCaption + "</p>\n";
  if (!comparison.alone.empty()) out += "<h2>Each method by itself</h2>\n" + htmlTable(aloneRows(comparison));
  std::string methods;
  for (const std::string& set : comparison.print.today) methods += " --set " + set;
  return out + "<h3>The methods of today, in one run</h3>\n<pre><code>presa run " + scene + escape(methods) +
         "</code></pre>\n<h3>Repeat this study</h3>\n<pre><code>" + escape(command) +
         "</code></pre>\n<p class=\"caption\">Lockstep virtual time, Presa " + escape(versionText()) + ".</p>\n" +
         page::tail();
}

std::string toCsv(const Comparison& comparison) {
  std::string out;
  for (const Texts& row : gridRows(comparison)) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i)
      line += (i == 0 ? "" : ",") + (row[i] == "–" ? "" : quotedCell(row[i], ','));
    out += line + '\n';
  }
  return out;
}

}  // namespace presa::printed
