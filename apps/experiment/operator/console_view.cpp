#include "apps/experiment/operator/console_view.h"

#include <algorithm>
#include <cmath>

namespace presa::experiment {
namespace {

using terminal::format;
using terminal::Style;

std::string minutes(double seconds) {
  if (seconds < 90) return format("%.0f s", seconds);
  return format("%.0f min", seconds / 60);
}

const char* nameOf(ContactMode mode) {
  return mode == ContactMode::kNone ? "free" : mode == ContactMode::kStick ? "stick" : "SLIP";
}

std::string progressBar(std::size_t done, std::size_t all, std::size_t cells) {
  const double share = all == 0 ? 1 : static_cast<double>(done) / static_cast<double>(all);
  return gauge(share, std::nan(""), 1, cells) + format(" %.0f %%", 100 * share);
}

ConsoleLine safetyOf(const SessionView& view) {
  if (view.device_lost) return {"safety     DEVICE LOST: forces are off", Style::kBad};
  std::string text;
  if (view.clipped > 0) text += format("  force at its limit for %.2f s", view.clipped);
  if (view.missed > 0) text += format("  %llu ticks late", static_cast<unsigned long long>(view.missed));
  if (text.empty()) return {"safety     in order", Style::kGood};
  return {"safety   " + text, Style::kWarning};
}

std::string fingersOf(const SessionView& view) {
  std::string text = "fingers  ";
  for (const SessionView::FingerStatus& finger : view.fingers)
    text += format("  %s %-5s %5.2f N", finger.role.c_str(), nameOf(finger.mode), finger.force);
  return text;
}

void addWatch(const SessionView::Watch& watch, std::size_t columns, ConsoleView& console_view) {
  if (watch.name.empty()) return;
  const std::string line = std::isnan(watch.line) ? "" : format("   line at %.2f %s", watch.line, watch.unit.c_str());
  const std::string head = format("%-9s  %6.2f %s  ", watch.name.c_str(), watch.value, watch.unit.c_str());
  const std::size_t used = head.size() + line.size();
  const std::size_t cells = columns > used + 12 ? columns - used - 2 : 10;
  console_view.push_back({head + "[" + gauge(watch.value, watch.line, watch.max, cells) + "]" + line,
                          watch.value < watch.line ? Style::kWarning : Style::kPlain});
}

/// Cuts the text to `columns` characters (UTF-8).
std::string cut(const std::string& text, std::size_t columns) {
  std::size_t seen = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if ((static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U && ++seen > columns) return text.substr(0, i);
  }
  return text;
}

}  // namespace

std::string gauge(double value, double line, double max, std::size_t cells) {
  std::string text(cells, '.');
  const auto cellOf = [&](double x) {
    return static_cast<std::size_t>(std::clamp(x / max, 0.0, 1.0) * static_cast<double>(cells));
  };
  if (value > 0 && max > 0) std::fill_n(text.begin(), cellOf(value), '#');
  if (line > 0 && max > 0 && cells > 0) text[std::min(cellOf(line), cells - 1)] = '|';
  return text;
}

std::vector<std::string> levelPlot(const std::vector<psychophysics::Trial>& answers, std::size_t columns,
                                   std::size_t rows) {
  if (answers.empty() || rows < 2 || columns < 20) return {};
  constexpr std::size_t kAxis = 10;
  const std::size_t shown = std::min(answers.size(), columns - kAxis);
  const auto first = answers.end() - static_cast<std::ptrdiff_t>(shown);
  double min = 0, max = 0;  // the range always contains the standard (level 0)
  for (auto one = first; one != answers.end(); ++one) {
    min = std::min(min, one->stimulus.level);
    max = std::max(max, one->stimulus.level);
  }
  if (max - min < 1e-9) max = min + 1;
  std::vector<std::string> lines(rows, std::string(kAxis, ' ') + std::string(shown, ' '));
  const auto rowOf = [&](double level) {
    return static_cast<std::size_t>(std::lround((max - level) / (max - min) * static_cast<double>(rows - 1)));
  };
  for (std::size_t i = 0; i < shown; ++i) lines[rowOf(0)][kAxis + i] = '.';
  for (std::size_t i = 0; i < shown; ++i) {
    const psychophysics::Trial& one = *(first + static_cast<std::ptrdiff_t>(i));
    lines[rowOf(one.stimulus.level)][kAxis + i] = !one.response ? 'o' : one.response->positive ? '+' : '-';
  }
  lines.front().replace(0, kAxis - 1, format("%*.3g", static_cast<int>(kAxis - 1), max));
  lines.back().replace(0, kAxis - 1, format("%*.3g", static_cast<int>(kAxis - 1), min));
  return lines;
}

ConsoleView consoleViewOf(const SessionView& view, std::size_t columns, std::size_t rows) {
  ConsoleView console_view;
  console_view.push_back({view.title, Style::kStrong});
  console_view.push_back({format("subject %s, session %d", view.subject.c_str(), view.session), Style::kDim});
  if (!view.model.empty()) console_view.push_back({view.model, Style::kWarning});
  console_view.push_back({format("%s %d%s, block %d     done %zu   left %zu   given up %zu     about %s left",
                                 view.practice ? "practice" : "trial", view.trial,
                                 view.attempt > 1 ? format(" (attempt %d)", view.attempt).c_str() : "", view.block,
                                 view.done, view.left, view.missing, minutes(view.seconds_left).c_str())});
  console_view.push_back({progressBar(view.done, view.done + view.left, columns > 20 ? columns - 6 : 8)});
  console_view.push_back({"condition  " + view.condition});
  console_view.push_back(
      {format("phase      %s   %.1f of %.0f s", view.phase.c_str(), view.phase_time, view.phase_limit),
       Style::kStrong});
  console_view.push_back({view.instruction.empty() ? "" : "           \"" + view.instruction + "\""});
  addWatch(view.watch, columns, console_view);
  console_view.push_back({fingersOf(view)});
  console_view.push_back(safetyOf(view));
  console_view.push_back({"last       " + view.last, Style::kDim});
  console_view.push_back({view.asked.empty() ? "p pause   r repeat   s skip   n note   q stop" : view.asked,
                          view.asked.empty() ? Style::kDim : Style::kWarning});
  const std::size_t room =
      rows > console_view.size() + 1 ? std::min<std::size_t>(rows - console_view.size() - 1, 12) : 0;
  for (const std::string& line : levelPlot(view.answers, columns, room)) console_view.push_back({line});
  for (ConsoleLine& line : console_view) line.text = cut(line.text, columns);
  if (console_view.size() > rows) console_view.resize(rows);
  return console_view;
}

}  // namespace presa::experiment
