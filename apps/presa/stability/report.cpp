#include "apps/presa/stability/report.h"

#include "apps/presa/report/page.h"
#include "apps/presa/report/svg_plot.h"
#include "apps/presa/stability/table.h"

namespace presa::stability {
namespace {

using svg::escape;

std::string caseSection(const Case& c, const std::vector<Row>& rows) {
  std::string out =
      "<h2 id=\"" + escape(c.name) + "\">" + escape(c.title) + "</h2>\n<p>" + escape(c.oracle) +
      "</p>\n<p class=\"caption\">" + escape(c.source) +
      "</p>\n<div class=\"scroll\"><table><tr><th>parameters</th><th>method</th><th>metric</th><th>value</th>"
      "<th>bound</th><th>verdict</th><th>expected</th></tr>\n";
  for (const Row& row : rows) {
    if (row.case_name != c.name) continue;
    out += "<tr><td>" + escape(parameterText(row.parameters)) + "</td><td>" + escape(row.method) + "</td><td>" +
           escape(row.finding.metric) + "</td><td>" + escape(valueText(row.finding.value, row.finding.unit)) +
           "</td><td>" + escape(valueText(row.finding.bound, row.finding.unit)) + "</td><td>" +
           toString(row.finding.verdict) + "</td><td>" + toString(row.expected) + "</td></tr>\n";
  }
  return out + "</table></div>\n";
}

}  // namespace

std::string reportHtml(const std::vector<Case>& cases, const std::vector<Row>& rows) {
  std::string out = page::head("Hard cases – Presa") + "<h1>Hard cases</h1>\n";
  for (const Case& c : cases) out += caseSection(c, rows);
  return out + page::tail();
}

}  // namespace presa::stability
