#include "apps/studies/stability/tally.h"

#include <algorithm>

namespace presa::stability {

void Tally::add(const Row& row) {
  ++all;
  stable += row.finding.verdict == Verdict::kStable ? 1 : 0;
  worse += row.worse() ? 1 : 0;
  worst = std::max(worst, row.finding.verdict);
}

std::vector<const Row*> rowsOfCase(const Case& c, const std::vector<Row>& rows) {
  std::vector<const Row*> found;
  for (const Row& row : rows) {
    if (row.case_name == c.name) found.push_back(&row);
  }
  return found;
}

const char* cssOf(Verdict verdict) {
  return verdict == Verdict::kStable ? "good" : verdict == Verdict::kDrift ? "warn" : "bad";
}

std::string signHtml(Verdict verdict) {
  const char* const sign = verdict == Verdict::kStable     ? "●"
                           : verdict == Verdict::kDrift    ? "◐"
                           : verdict == Verdict::kUnstable ? "✕"
                                                           : "⊘";
  return std::string("<span class=\"sign\" role=\"img\" aria-label=\"") + toString(verdict) + "\">" + sign + "</span>";
}

std::string worseSignHtml() { return "<span class=\"sign\" role=\"img\" aria-label=\"worse than expected\">▼</span>"; }

}  // namespace presa::stability
