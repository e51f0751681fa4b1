#include "apps/common/report/page.h"
#include "apps/common/report/svg_plot.h"
#include "apps/common/terminal/text.h"
#include "apps/common/version.h"
#include "apps/studies/faults/runner.h"

namespace presa::faults {
namespace {

using terminal::format;

/// Worst value and bound in milliseconds, such as "3.0 (3)"; "–" without a bound.
std::string milliseconds(double worst, double bound) {
  if (!(bound > 0)) return "–";
  return worst < 0 ? "never" : format("%.1f (%g)", 1e3 * worst, 1e3 * bound);
}

std::string energy(const Row& row) {
  if (!row.fault.bounds.energy) return "–";
  return row.energy_beyond > 0 ? format("%.3g mJ", 1e3 * row.energy_beyond) : "none";
}

const char* kColumns[] = {"row",           "fault",     "required",         "runs",
                          "detected [ms]", "zero [ms]", "largest step [N]", "energy to the hand",
                          "invariants",    "broke it"};

std::vector<std::string> cellsOf(const Row& row) {
  return {std::to_string(row.fault.row),
          row.fault.name,
          row.fault.required,
          std::to_string(row.runs),
          milliseconds(row.worst.detection, row.fault.bounds.detection),
          milliseconds(row.worst.zero, row.fault.bounds.zero),
          format("%.4f", row.worst.step),
          energy(row),
          row.watched ? "held" : "broken",
          row.broken == 0 ? "0" : format("%d: %s", row.broken, row.reason.c_str())};
}

std::string listed(const Row& row, const char* what, const std::vector<std::string>& lines, const char* line_end) {
  if (lines.empty()) return {};
  std::string text = format("row %d: %zu %s:%s", row.fault.row, lines.size(), what, line_end);
  for (const std::string& line : lines) text += "  " + svg::escape(line) + line_end;
  return text;
}

/// What the machine had to do with the runs of a row; empty: nothing.
std::string machineText(const Row& row, const char* line_end) {
  return listed(row, "of these runs were late because the machine ran nobody for a while", row.delayed, line_end) +
         listed(row, "attempts in which the program never pressed", row.not_started, line_end);
}

}  // namespace

nlohmann::ordered_json toJson(const std::vector<Row>& rows) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const Row& row : rows) {
    all.push_back({{"row", row.fault.row},
                   {"fault", row.fault.name},
                   {"required", row.fault.required},
                   {"runs", row.runs},
                   {"worst_detection_s", row.worst.detection},
                   {"detection_bound_s", row.fault.bounds.detection},
                   {"worst_zero_s", row.worst.zero},
                   {"zero_bound_s", row.fault.bounds.zero},
                   {"largest_step_n", row.worst.step},
                   {"energy_beyond_sampling_j", row.energy_beyond},
                   {"invariants_held", row.watched},
                   {"broken", row.broken},
                   {"reason", row.reason},
                   {"delayed", row.delayed},
                   {"not_started", row.not_started}});
  }
  return {{"format", 1}, {"presa", kVersion}, {"faults", all}};
}

std::string tableText(const std::vector<Row>& rows) {
  std::string text = format("%3s  %-46s %5s  %14s %12s %9s  %-12s %-10s %s\n", "row", "fault", "runs", "detected [ms]",
                            "zero [ms]", "step [N]", "energy", "invariants", "broke it");
  for (const Row& row : rows) {
    const auto cells = cellsOf(row);
    text += format("%3s  %-46s %5s  %14s %12s %9s  %-12s %-10s %s\n", cells[0].c_str(), cells[1].c_str(),
                   cells[3].c_str(), cells[4].c_str(), cells[5].c_str(), cells[6].c_str(), cells[7].c_str(),
                   cells[8].c_str(), cells[9].c_str());
  }
  for (const Row& row : rows) text += machineText(row, "\n");
  return text +
         "worst of all runs (bound); steps may be 1 N in a tick; energy beyond what sampling a spring may add;\n"
         "invariants: every force finite, below the limit, within the slew limit, zero before the first sample and "
         "after a loss\n";
}

std::string pageHtml(const std::vector<Row>& rows, const RunnerOptions& options) {
  std::string html = page::head("Presa: faults") + "<h1>What goes wrong under a hand, and what happens then</h1>\n";
  html += format(
      "<p>Two fingers hold a cube with 3 to 4 N each, in lockstep; each fault comes at %d random moments (seed "
      "%llu). Judged is what was written to the devices. Worst of all runs, bounds in brackets. The numbers of the "
      "rows are those of the fault table. Invariants, looked at by a watch of its own before every device: every force "
      "finite, never above the limit, never faster than the slew limit, zero before the first usable sample and after "
      "a "
      "loss.</p>\n",
      options.runs, static_cast<unsigned long long>(options.seed));
  html += "<div class=\"scroll\"><table><thead><tr>";
  const auto isWords = [](std::size_t column) { return column == 1 || column == 2; };
  for (std::size_t i = 0; i < std::size(kColumns); ++i)
    html += format("<th class=\"%s\">%s</th>", isWords(i) ? "words" : "", kColumns[i]);
  html += "</tr></thead><tbody>\n";
  for (const Row& row : rows) {
    html += "<tr>";
    const auto cells = cellsOf(row);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const bool words = isWords(i), verdict = i + 1 == cells.size();
      const char* css = words ? "words" : !verdict ? "" : row.broken == 0 ? "good" : "words bad";
      html += format("<td class=\"%s\">", css) + svg::escape(cells[i]) + "</td>";
    }
    html += "</tr>\n";
  }
  html += "</tbody></table></div>\n";
  for (const Row& row : rows)
    if (const std::string text = machineText(row, "<br>\n"); !text.empty()) html += "<p>" + text + "</p>\n";
  return html + page::tail();
}

}  // namespace presa::faults
