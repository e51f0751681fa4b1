#include "apps/studies/stability/table.h"

#include <algorithm>
#include <cmath>

#include "apps/common/terminal/status_line.h"
#include "apps/common/terminal/text.h"

namespace presa::stability {
namespace {

using terminal::Style;

Style styleOf(const Row& row) {
  if (row.worse()) return Style::kBad;
  return row.finding.verdict == Verdict::kStable ? Style::kGood : Style::kWarning;
}

std::string line(const Row& row, std::size_t parameter_width, bool color) {
  std::string parameters = parameterText(row.parameters);
  parameters.resize(std::max(parameters.size(), parameter_width), ' ');
  const std::string left =
      terminal::format("  %s  %-18s %-34s %14s  ", parameters.c_str(), row.method.c_str(), row.finding.metric.c_str(),
                       valueText(row.finding.value, row.finding.unit).c_str());
  std::string out = left + terminal::styled(toString(row.finding.verdict), styleOf(row), color);
  if (row.worse()) out += terminal::styled(std::string("  expected ") + toString(row.expected), Style::kBad, color);
  if (!row.reason.empty()) out += "  (" + row.reason + ")";
  return out + "\n";
}

std::string closing(const std::vector<Row>& rows, const std::string& out, bool color) {
  std::size_t worse = 0, stable = 0, own = 0;
  for (const Row& row : rows) {
    worse += row.worse() ? 1 : 0;
    if (row.method != kPresa) continue;
    ++own;
    stable += row.finding.verdict == Verdict::kStable ? 1 : 0;
  }
  std::string text = terminal::format("%zu of %zu findings of Presa's methods are stable; ", stable, own);
  text += worse == 0 ? terminal::styled("none is worse than expected.", Style::kGood, color)
                     : terminal::styled(terminal::format("%zu worse than expected.", worse), Style::kBad, color);
  if (!out.empty()) text += "\nReport: " + out + "/report.html   rows: " + out + "/rows.jsonl";
  return text + "\n";
}

}  // namespace

std::string valueText(double value, const std::string& unit) {
  if (!std::isfinite(value)) return "no number";
  return terminal::format("%.3g", value) + (unit.empty() ? "" : " " + unit);
}

std::string parameterText(const Parameters& parameters) {
  std::string text;
  for (const auto& [name, value] : parameters) text += (text.empty() ? "" : ", ") + name + " " + value;
  return text;
}

std::string tableText(const std::vector<Case>& cases, const std::vector<Row>& rows, const std::string& out) {
  const bool color = wantsColor(stdout);
  std::string text;
  for (const Case& c : cases) {
    std::size_t width = 0;
    for (const Row& row : rows) {
      if (row.case_name == c.name) width = std::max(width, parameterText(row.parameters).size());
    }
    std::string block;
    for (const Row& row : rows) {
      if (row.case_name == c.name) block += line(row, width, color);
    }
    if (!block.empty()) text += terminal::styled(c.name, Style::kStrong, color) + ": " + c.title + "\n" + block + "\n";
  }
  return text + closing(rows, out, color);
}

}  // namespace presa::stability
