#include "apps/studies/stability/report.h"

#include <algorithm>
#include <cmath>

#include "apps/common/report/page.h"
#include "apps/common/report/svg_plot.h"
#include "apps/common/terminal/text.h"
#include "apps/common/version.h"
#include "apps/studies/stability/curves.h"
#include "apps/studies/stability/table.h"

namespace presa::stability {
namespace {

using svg::escape;
using terminal::format;

struct Tally {
  std::size_t stable = 0, all = 0;
  std::string text() const { return all == 0 ? "–" : format("%zu of %zu", stable, all); }
};

template <class Wanted>
Tally tally(const std::vector<Row>& rows, const Wanted& wanted) {
  Tally result;
  for (const Row& row : rows) {
    if (!wanted(row)) continue;
    ++result.all;
    result.stable += row.finding.verdict == Verdict::kStable ? 1 : 0;
  }
  return result;
}

const char* cssOf(Verdict verdict) {
  return verdict == Verdict::kStable ? "good" : verdict == Verdict::kDrift ? "warn" : "bad";
}

std::string cell(const std::string& text, const std::string& css = {}) {
  return css.empty() ? "<td>" + escape(text) + "</td>" : "<td class=\"" + css + "\">" + escape(text) + "</td>";
}

std::string tallyCell(const Tally& t) { return cell(t.text(), t.all == 0 ? "" : t.stable == t.all ? "good" : "bad"); }

/// Largest share of a bound that Presa's results reach; 1: at the bound.
double worstShare(const Case& c, const std::vector<Row>& rows) {
  double worst = 0;
  for (const Row& row : rows) {
    if (row.case_name != c.name || row.method != kPresa || !(row.finding.bound > 0)) continue;
    worst = std::max(worst, std::abs(row.finding.value) / row.finding.bound);
  }
  return worst;
}

std::string overview(const std::vector<Case>& cases, const std::vector<Row>& rows) {
  std::string out =
      "<div class=\"scroll\"><table><thead><tr><th>case</th><th>Presa: stable</th><th>what it replaces: stable</th>"
      "<th>largest share of a bound</th></tr></thead><tbody>\n";
  for (const Case& c : cases) {
    const auto of = [&](bool own) {
      return tally(rows, [&, own](const Row& row) { return row.case_name == c.name && (row.method == kPresa) == own; });
    };
    if (of(true).all + of(false).all == 0) continue;
    out += "<tr><td><a href=\"#" + escape(c.name) + "\">" + escape(c.title) + "</a></td>" + tallyCell(of(true)) +
           tallyCell(of(false)) + cell(format("%.3g", worstShare(c, rows))) + "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

/// The methods of a case in order of appearance, Presa's first.
std::vector<std::string> methodsOf(const Case& c, const std::vector<Row>& rows) {
  std::vector<std::string> methods{kPresa};
  for (const Row& row : rows) {
    const bool known = std::find(methods.begin(), methods.end(), row.method) != methods.end();
    if (row.case_name == c.name && !known) methods.push_back(row.method);
  }
  return methods;
}

std::string resultCell(const Row& row) {
  std::string text = row.finding.verdict == Verdict::kFailed && !row.reason.empty()
                         ? "failed: " + row.reason
                         : valueText(row.finding.value, row.finding.unit) + ", " + toString(row.finding.verdict);
  if (row.worse()) text += std::string(", expected ") + toString(row.expected);
  return cell(text, cssOf(row.finding.verdict));
}

/// HTML table with a line per parameter set and metric, a column per method.
std::string caseTable(const Case& c, const std::vector<Row>& rows) {
  const std::vector<std::string> methods = methodsOf(c, rows);
  std::string out =
      "<div class=\"scroll\"><table><thead><tr><th>parameters</th><th>metric</th><th>held against</th><th>bound</th>";
  for (const std::string& method : methods) out += "<th>" + escape(method) + "</th>";
  out += "</tr></thead><tbody>\n";
  std::vector<const Row*> heads;  // first row of each line
  const auto same_line = [](const Row& a, const Row& b) {
    return a.parameters == b.parameters && a.finding.metric == b.finding.metric;
  };
  for (const Row& row : rows) {
    if (row.case_name != c.name) continue;
    if (std::any_of(heads.begin(), heads.end(), [&](const Row* head) { return same_line(*head, row); })) continue;
    heads.push_back(&row);
  }
  for (const Row* head : heads) {
    out += "<tr>" + cell(parameterText(head->parameters)) + cell(head->finding.metric, "words") +
           cell(head->finding.oracle, "words") + cell(valueText(head->finding.bound, head->finding.unit));
    for (const std::string& method : methods) {
      const auto found = std::find_if(rows.begin(), rows.end(), [&](const Row& row) {
        return row.case_name == c.name && row.method == method && same_line(row, *head);
      });
      out += found == rows.end() ? cell("–") : resultCell(*found);
    }
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string caseSection(const Case& c, const std::vector<Row>& rows) {
  if (std::none_of(rows.begin(), rows.end(), [&](const Row& row) { return row.case_name == c.name; })) return {};
  return "<h2 id=\"" + escape(c.name) + "\">" + escape(c.title) + "</h2>\n<p>" + escape(c.oracle) +
         "</p>\n<p class=\"caption\">" + escape(c.source) + " See it: <code>presa run experiments/stability/scenes/" +
         escape(c.scene) + "</code></p>\n" + curvesHtml(c, rows) + caseTable(c, rows);
}

std::string verdictBlock(const std::vector<Row>& rows) {
  const Tally own = tally(rows, [](const Row& row) { return row.method == kPresa; });
  const Tally replaced = tally(rows, [](const Row& row) { return row.method != kPresa; });
  const auto worse =
      static_cast<std::size_t>(std::count_if(rows.begin(), rows.end(), [](const Row& row) { return row.worse(); }));
  return "<div class=\"verdict " + std::string(worse == 0 ? "good" : "bad") + "\"><b>" +
         (worse == 0 ? "No verdict is worse than expected" : format("%zu verdicts are worse than expected", worse)) +
         "</b>\n<p>Presa's methods: " + own.text() + " findings stable. What they replace: " + replaced.text() +
         ".</p>\n</div>\n";
}

}  // namespace

std::string reportHtml(const std::vector<Case>& cases, const std::vector<Row>& rows) {
  std::string out =
      page::head("Hard cases – Presa") +
      "<h1>Hard cases</h1>\n<p class=\"lead\">Each case in lockstep virtual time, with Presa's method and with "
      "what that replaces, held against an answer that comes from elsewhere.</p>\n";
  out += verdictBlock(rows) + "<h2>Overview</h2>\n" + overview(cases, rows) +
         "<p class=\"caption\">Stable: within the bound. Drift: up to ten times the bound. Unstable: beyond, or no "
         "number. "
         "Failed: the trial did not end.</p>\n";
  for (const Case& c : cases) out += caseSection(c, rows);
  return out + "<p class=\"caption\">Presa " + std::string(kVersion) + "</p>\n" + page::tail();
}

}  // namespace presa::stability
