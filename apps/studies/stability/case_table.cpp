#include "apps/studies/stability/case_table.h"

#include <algorithm>

#include "apps/common/report/svg_plot.h"
#include "apps/studies/stability/table.h"
#include "apps/studies/stability/tally.h"

namespace presa::stability {
namespace {

using svg::escape;
using CaseRows = std::vector<const Row*>;

/// The methods of a case in order of appearance, Presa's first.
std::vector<std::string> methodsOf(const CaseRows& rows) {
  std::vector<std::string> methods{kPresa};
  for (const Row* row : rows) {
    if (std::find(methods.begin(), methods.end(), row->method) == methods.end()) methods.push_back(row->method);
  }
  return methods;
}

std::string boundText(const Row& row) { return valueText(row.finding.bound, row.finding.unit); }

/// The rows of one metric.
struct Group {
  CaseRows rows;
  const Row& first() const { return *rows.front(); }
  bool sameOracle() const {
    return std::all_of(rows.begin(), rows.end(),
                       [&](const Row* row) { return row->finding.oracle == first().finding.oracle; });
  }
  bool sameBound() const {
    return std::all_of(rows.begin(), rows.end(), [&](const Row* row) { return boundText(*row) == boundText(first()); });
  }
};

std::vector<Group> groupsOf(const CaseRows& rows) {
  std::vector<Group> groups;
  for (const Row* row : rows) {
    auto group = std::find_if(groups.begin(), groups.end(),
                              [&](const Group& g) { return g.first().finding.metric == row->finding.metric; });
    if (group == groups.end()) group = groups.insert(group, Group{});
    group->rows.push_back(row);
  }
  return groups;
}

/// "held against k depth = 20 N; bound 1 %": of `row`, as far as wanted.
std::string reference(const Row& row, bool oracle, bool bound) {
  std::string text = oracle ? "held against " + row.finding.oracle : "";
  if (bound) text += (oracle ? "; bound " : "bound ") + boundText(row);
  return escape(text);
}

std::string resultCell(const Row& row) {
  const Verdict verdict = row.finding.verdict;
  std::string text;
  if (verdict == Verdict::kFailed && !row.reason.empty()) {
    text = signHtml(verdict) + " failed: " + escape(row.reason);
  } else {
    text = "<span class=\"count\">" + signHtml(verdict) + " " + escape(valueText(row.finding.value, row.finding.unit)) +
           "</span>";
    if (verdict != Verdict::kStable) text += std::string(" <small>") + toString(verdict) + "</small>";
  }
  if (row.worse()) text += " " + worseSignHtml() + " <small>expected " + toString(row.expected) + "</small>";
  return std::string("<td class=\"") + cssOf(verdict) + "\">" + text + "</td>";
}

std::string groupHtml(const Group& group, const std::vector<std::string>& methods) {
  const bool same_oracle = group.sameOracle(), same_bound = group.sameBound();
  std::string out = "<tbody><tr class=\"metric\"><th scope=\"rowgroup\" colspan=\"" +
                    std::to_string(methods.size() + 1) + "\"><div><b>" + escape(group.first().finding.metric) +
                    "</b> " + reference(group.first(), same_oracle, same_bound) + "</div></th></tr>\n";
  CaseRows heads;  // first row of each parameter set
  for (const Row* row : group.rows) {
    const bool known =
        std::any_of(heads.begin(), heads.end(), [&](const Row* head) { return head->parameters == row->parameters; });
    if (!known) heads.push_back(row);
  }
  for (const Row* head : heads) {
    out += "<tr><th scope=\"row\">" + escape(parameterText(head->parameters));
    if (!same_oracle || !same_bound) out += "<small>" + reference(*head, !same_oracle, !same_bound) + "</small>";
    out += "</th>";
    for (const std::string& method : methods) {
      const auto found = std::find_if(group.rows.begin(), group.rows.end(), [&](const Row* row) {
        return row->method == method && row->parameters == head->parameters;
      });
      out += found == group.rows.end() ? "<td class=\"none\">–</td>" : resultCell(**found);
    }
    out += "</tr>\n";
  }
  return out + "</tbody>\n";
}

}  // namespace

std::string caseTableHtml(const Case& c, const std::vector<Row>& rows) {
  const CaseRows own = rowsOfCase(c, rows);
  const std::vector<std::string> methods = methodsOf(own);
  std::string out = "<div class=\"scroll\"><table class=\"rows\"><thead><tr><th scope=\"col\">parameters</th>";
  for (const std::string& method : methods) {
    out += "<th scope=\"col\">" + (method == kPresa ? std::string("Presa") : escape(method)) + "</th>";
  }
  out += "</tr></thead>\n";
  for (const Group& group : groupsOf(own)) out += groupHtml(group, methods);
  return out + "</table></div>\n";
}

}  // namespace presa::stability
