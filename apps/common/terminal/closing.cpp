#include "apps/common/terminal/closing.h"

#include <cstdio>
#include <cstdlib>

#include "apps/common/summary.h"
#include "apps/common/terminal/status_line.h"
#include "apps/common/terminal/text.h"
#include "apps/common/verdict.h"
#include "framework/core/diagnostics/printable.h"

namespace presa {
namespace {

using terminal::format;
using terminal::Style;
using terminal::styled;
using terminal::wrapped;

Style styleOf(Verdict::Outcome outcome) {
  switch (outcome) {
    case Verdict::Outcome::kGood:
      return Style::kGood;
    case Verdict::Outcome::kBad:
      return Style::kBad;
    case Verdict::Outcome::kNeutral:
      break;
  }
  return Style::kStrong;
}

/// Forces along the normal as rendered, and the largest that the device was sent.
std::string contactTable(const RunResult& result) {
  std::string out = format("  %-14s %8s %8s %8s %9s %9s %9s\n", "contact point", "free s", "stick s", "slip s",
                           "mean N", "max N", "sent max");
  for (const RunResult::ContactPoint& point : result.contact_points) {
    const FingerSummary& sum = point.summary;
    out += format("  %-14s %8.3f %8.3f %8.3f %9.3f %9.3f %9.3f\n", printable(point.name).c_str(), sum.seconds[0],
                  sum.seconds[1], sum.seconds[2], sum.mean_normal_force, sum.max_normal_force, sum.max_commanded_force);
  }
  return out;
}

/// Of tools with volume. Coarse: ticks that examined the tool's surface more coarsely than it is given; late: ticks that
/// did not bring tool and forces into balance.
std::string toolTable(const RunResult& result) {
  std::string out =
      format("  %-14s %8s %10s %11s %9s %9s\n", "tool", "ticks", "deepest mm", "most points", "coarse", "late");
  for (const ToolSummary& tool : result.tools) {
    out += format("  %-14s %8u %10.3f %11u %9u %9u\n", printable(tool.name).c_str(), tool.touched, 1e3 * tool.deepest,
                  tool.most_points, tool.coarse, tool.late);
  }
  return out;
}

/// At most 80 columns, in real time, too.
std::string rateTable(const RunResult& result) {
  std::string out = format("  %-14s %6s %9s %7s %7s %7s", "rate", "Hz", "ticks", "late", "p50 us", "p99 us");
  out += result.realtime ? format(" %8s %11s\n", "p99 late", "max late us") : std::string("\n");
  for (const RunResult::Rate& rate : result.rates) {
    const GroupTiming& timing = *rate.timing;
    const auto us = [](std::int64_t ns) { return static_cast<double>(ns) / 1000; };
    out += format("  %-14s %6.0f %9llu %7llu %7.1f %7.1f", toString(rate.group), rate.rate_hz,
                  static_cast<unsigned long long>(timing.ticks.load()),
                  static_cast<unsigned long long>(timing.missed.load()), us(timing.execution.percentile(0.5)),
                  us(timing.execution.percentile(0.99)));
    out += result.realtime ? format(" %8.1f %11.1f\n", us(timing.lateness.percentile(0.99)), us(timing.lateness.max()))
                           : std::string("\n");
  }
  return out;
}

/// The symbol of static friction in ASCII where the terminal does not show UTF-8.
std::string forTerminal(std::string text) {
  for (const char* variable : {"LC_ALL", "LC_CTYPE", "LANG"}) {
    const char* set = std::getenv(variable);
    if (set == nullptr || *set == '\0') continue;
    const std::string locale = set;
    if (locale.find("UTF-8") != std::string::npos || locale.find("utf8") != std::string::npos) return text;
    break;
  }
  const std::string symbol = "μₛ";
  for (std::size_t at = 0; (at = text.find(symbol, at)) != std::string::npos;) text.replace(at, symbol.size(), "mu_s");
  return text;
}

}  // namespace

std::string closingText(const RunResult& result, const std::string& summary_file, const std::string& report_file,
                        bool color, std::size_t columns) {
  const Verdict verdict = verdictOf(result);
  const auto lines = [columns](const std::string& text) { return wrapped("  " + text, columns, 4); };
  std::string out = styled(wrapped(printable(verdict.headline), columns, 4), styleOf(verdict.outcome), color) + "\n";
  for (const std::string& detail : verdict.details) out += lines(printableLines(detail)) + "\n";
  for (const std::string& warning : verdict.warnings)
    out += styled(lines("warning: " + printable(warning)), Style::kWarning, color) + "\n";
  out += contactTable(result) + (result.tools.empty() ? std::string() : toolTable(result)) + rateTable(result);
  const double speed = result.wall_seconds > 0 ? result.simulated_seconds / result.wall_seconds : 0;
  out += format("  %.3f s simulated in %.3f s (%.1fx), state hash %s\n", result.simulated_seconds, result.wall_seconds,
                speed, hashText(result.state_hash).c_str());
  for (const std::string& missing : result.realtime_missing)
    out += styled(lines(missing), Style::kWarning, color) + "\n";
  for (const RunResult::Fault& fault : result.faults) {
    out += styled(lines(format("%.3f s: ", fault.time) + printable(fault.text)), Style::kBad, color) + "\n";
  }
  if (!result.recording.file.empty()) out += "  recording: " + result.recording.file + "\n";
  for (const std::string& file : result.flight_records)
    out += "  the seconds around the fault: " + file + " (presa replay " + file + ")\n";
  if (!summary_file.empty()) out += "  summary: " + summary_file + "\n";
  if (!report_file.empty()) out += "  report: " + report_file + "\n";
  return out;
}

void printClosing(const RunResult& result, const std::string& summary_file, const std::string& report_file) {
  const std::string text =
      closingText(result, summary_file, report_file, wantsColor(stdout), terminal::columnsOf(stdout));
  std::fputs(forTerminal(text).c_str(), stdout);
}

}  // namespace presa
