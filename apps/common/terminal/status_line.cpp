#include "apps/common/terminal/status_line.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "apps/common/terminal/text.h"
#include "framework/core/diagnostics/printable.h"
#include "framework/core/schedule/clock.h"

namespace presa {
namespace {

constexpr std::int64_t kRefresh = 100'000'000;      // [ns] on a terminal
constexpr std::int64_t kPlainLine = 2'000'000'000;  // [ns] in a log
constexpr std::size_t kBarMin = 4, kBarMax = 20;

using terminal::Line;
using terminal::Style;

Style styleOf(ContactMode mode) {
  switch (mode) {
    case ContactMode::kStick:
      return Style::kGood;
    case ContactMode::kSlip:
      return Style::kWarning;
    case ContactMode::kNone:
      break;
  }
  return Style::kDim;
}

const char* nameOf(ContactMode mode) {
  switch (mode) {
    case ContactMode::kStick:
      return "stick";
    case ContactMode::kSlip:
      return "slip ";
    case ContactMode::kNone:
      break;
  }
  return "free ";
}

bool hasEnd(const LiveStatus& status) { return std::isfinite(status.duration) && status.duration > 0; }

std::string timeText(const LiveStatus& status) {
  return hasEnd(status) ? terminal::format("%.1f/%.1f s", status.time, status.duration)
                        : terminal::format("%.1f s", status.time);
}

std::string fingerText(const LiveStatus::FingerStatus& finger) {
  return terminal::format("%s %5.2f N %s", finger.name.c_str(), finger.normal_force, nameOf(finger.mode));
}

/// The bar is as long as the fingers leave room for; without an end, or where there is none, it is empty.
std::string progressBar(const LiveStatus& status, std::size_t columns) {
  std::size_t others = terminal::widthOf(timeText(status)) + 4;  // brackets and a gap
  if (!status.phase.empty()) others += terminal::widthOf(printable(status.phase)) + 2;
  for (const LiveStatus::FingerStatus& finger : status.fingers)
    others += terminal::widthOf(printable(fingerText(finger))) + 2;
  if (!hasEnd(status) || columns < others + kBarMin) return {};
  const std::size_t width = std::min(kBarMax, columns - others);
  const double part = std::clamp(status.time / status.duration, 0.0, 1.0);
  const auto filled = static_cast<std::size_t>(std::lround(part * static_cast<double>(width)));
  return "[" + std::string(filled, '#') + std::string(width - filled, '.') + "]";
}

void addTimeLeft(Line& line, const LiveStatus& status, double rate) {
  if (!hasEnd(status)) return;
  const double speed = status.realtime ? 1.0 : rate;
  if (!(speed > 0)) return;
  line.add(terminal::format("%.0f s left", std::ceil(std::max(0.0, status.duration - status.time) / speed)),
           Style::kDim);
}

}  // namespace

std::string statusText(const LiveStatus& status, double rate, std::size_t columns, bool color) {
  Line line(columns, color);
  if (const std::string bar = progressBar(status, columns); !bar.empty()) line.add(bar);
  line.add(timeText(status));
  if (!status.phase.empty()) line.add(status.phase, Style::kStrong);
  for (const LiveStatus::FingerStatus& finger : status.fingers) {
    line.add(fingerText(finger), styleOf(finger.mode));
  }
  if (status.losses > 0) line.add(terminal::format("%u lost", status.losses), Style::kWarning);
  line.add(status.realtime ? terminal::format("%.0f Hz", rate) : terminal::format("%.1fx", rate));
  if (status.haptic_missed > 0) {
    line.add(terminal::format("%llu late", static_cast<unsigned long long>(status.haptic_missed)), Style::kWarning);
  }
  addTimeLeft(line, status, rate);
  return line.text();
}

bool wantsColor(std::FILE* stream) {
  const char* no_color = std::getenv("NO_COLOR");
  return ::isatty(::fileno(stream)) == 1 && (no_color == nullptr || *no_color == '\0');
}

StatusLine::StatusLine(bool quiet)
    : quiet_(quiet), terminal_(::isatty(STDERR_FILENO) == 1), color_(wantsColor(stderr)) {
  // a log line reports progress; at the start of a run there is none
  next_ns_ = monotonicNs() + (terminal_ ? kRefresh : kPlainLine);
}

StatusLine::~StatusLine() { finish(); }

bool StatusLine::due() const { return !quiet_ && monotonicNs() >= next_ns_; }

void StatusLine::show(const LiveStatus& status) {
  if (quiet_) return;
  const double rate = recentRate(status);
  // one column stays free: a full line would wrap on some terminals
  const std::size_t columns = terminal_ ? std::max<std::size_t>(20, terminal::columnsOf(stderr) - 1) : 200;
  const std::string text = statusText(status, rate, columns, color_);
  if (terminal_) {
    std::fprintf(stderr, "\r\033[K%s", text.c_str());
    shown_ = true;
  } else {
    std::fprintf(stderr, "%s\n", text.c_str());
  }
  std::fflush(stderr);
  next_ns_ = monotonicNs() + (terminal_ ? kRefresh : kPlainLine);
}

double StatusLine::recentRate(const LiveStatus& status) {
  const double wall = status.wall_seconds - last_wall_;
  const double done =
      status.realtime ? static_cast<double>(status.haptic_ticks - last_ticks_) : status.time - last_time_;
  last_wall_ = status.wall_seconds;
  last_time_ = status.time;
  last_ticks_ = status.haptic_ticks;
  return wall > 0 ? done / wall : 0;
}

void StatusLine::note(const std::string& text) {
  if (quiet_) return;
  clear();
  std::fprintf(stderr, "%s\n", terminal::wrapped("note: " + printable(text), terminal::columnsOf(stderr), 6).c_str());
}

void StatusLine::clear() {
  if (shown_) std::fputs("\r\033[K", stderr);
  shown_ = false;
}

void StatusLine::finish() {
  clear();
  std::fflush(stderr);
}

}  // namespace presa
