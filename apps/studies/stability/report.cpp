#include "apps/studies/stability/report.h"

#include "apps/common/report/page.h"
#include "apps/common/report/svg_plot.h"
#include "apps/common/terminal/text.h"
#include "apps/common/version.h"
#include "apps/studies/stability/case_table.h"
#include "apps/studies/stability/curves.h"
#include "apps/studies/stability/overview.h"
#include "apps/studies/stability/report_style.h"
#include "apps/studies/stability/tally.h"

namespace presa::stability {
namespace {

using svg::escape;
using terminal::format;

std::string stableOf(const Tally& tally) {
  return tally.all == 0 ? "–" : format("%zu of %zu", tally.stable, tally.all);
}

std::string verdictBlock(const std::vector<Row>& rows) {
  Tally own, replaced;
  for (const Row& row : rows) (row.method == kPresa ? own : replaced).add(row);
  const std::size_t worse = own.worse + replaced.worse;
  return "<div class=\"verdict " + std::string(worse == 0 ? "good" : "bad") + "\"><b>" +
         (worse == 0 ? "No verdict is worse than expected" : format("%zu verdicts are worse than expected", worse)) +
         "</b>\n<p>Presa's methods: " + stableOf(own) + " findings stable. What they replace: " + stableOf(replaced) +
         ".</p>\n</div>\n";
}

std::string legend() {
  return "<p class=\"caption\">A cell counts the stable findings of a case under a family of methods; its sign is that "
         "of the worst: " +
         signHtml(Verdict::kStable) + "&nbsp;stable, within the bound; " + signHtml(Verdict::kDrift) +
         "&nbsp;drift, up to ten times the bound; " + signHtml(Verdict::kUnstable) +
         "&nbsp;unstable, beyond, or no number; " + signHtml(Verdict::kFailed) +
         "&nbsp;failed, the trial did not end. " + worseSignHtml() +
         "&nbsp;marks what is worse than expected. Share of bound: the largest that Presa's results reach.</p>\n";
}

/// A case, closed unless a verdict is worse than expected; empty without rows.
std::string caseHtml(const Case& c, const std::vector<Row>& rows) {
  Tally all, own;
  for (const Row* row : rowsOfCase(c, rows)) {
    all.add(*row);
    if (row->method == kPresa) own.add(*row);
  }
  if (all.all == 0) return {};
  std::string out = "<details class=\"case\" id=\"" + escape(c.name) + "\"" + (all.worse > 0 ? " open" : "") +
                    "><summary><b>" + escape(c.title) + "</b>";
  if (own.all > 0) {
    out += std::string(" <span class=\"fill ") + cssOf(own.worst) + "\">" + signHtml(own.worst) +
           format(" %zu/%zu", own.stable, own.all) + "</span>";
  }
  if (all.worse > 0) {
    out += " <span class=\"fill bad\">" + worseSignHtml() + format(" %zu worse than expected", all.worse) + "</span>";
  }
  return out + "</summary>\n<p>" + escape(c.oracle) + "</p>\n<p class=\"caption\">" + escape(c.source) +
         " See it: <code>presa run experiments/stability/scenes/" + escape(c.scene) + "</code></p>\n" +
         curvesHtml(c, rows) + caseTableHtml(c, rows) + "</details>\n";
}

}  // namespace

std::string reportHtml(const std::vector<Case>& cases, const std::vector<Row>& rows) {
  std::string out =
      page::head("Hard cases – Presa", kReportStyle) +
      "<h1>Hard cases</h1>\n<p class=\"lead\">Each case in lockstep virtual time, with Presa's method and with "
      "what that replaces, held against an answer that comes from elsewhere.</p>\n";
  out += verdictBlock(rows) + "<h2>Overview</h2>\n" + overviewHtml(cases, rows) + legend() +
         "<h2>Cases</h2>\n<p class=\"caption\">Each opens into its reference, plots and rows; those with a verdict "
         "worse than expected are open. Paper shows the overview and the cases that are open.</p>\n"
         "<p class=\"tools\" hidden><button type=\"button\" data-open=\"all\">open all</button><button "
         "type=\"button\" data-open=\"none\">close all</button></p>\n";
  for (const Case& c : cases) out += caseHtml(c, rows);
  return out + "<p class=\"caption\">Presa " + escape(versionText()) + "</p>\n<script>" + kReportScript +
         "</script>\n" + page::tail();
}

}  // namespace presa::stability
