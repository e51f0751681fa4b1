#include "apps/common/terminal/waiting.h"

#include <unistd.h>

#include <chrono>
#include <cstdio>

#include "apps/common/terminal/text.h"
#include "framework/core/diagnostics/printable.h"

namespace presa::terminal {

constexpr int kQuietSeconds = 2;

std::string waitingText(const std::string& what, int seconds, std::size_t columns) {
  const std::string tail = ", " + std::to_string(seconds) + " s";
  std::string shown = printable(what);
  const std::size_t room = columns > tail.size() + 1 ? columns - tail.size() - 1 : 0;
  if (shown.size() > room) shown = shown.substr(shown.size() - room);
  return shown + tail;
}

Waiting::Waiting(std::string what) : what_(std::move(what)) {
  if (::isatty(STDERR_FILENO) != 0) thread_ = std::thread([this] { show(); });
}

Waiting::~Waiting() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    end_ = true;
  }
  ended_.notify_one();
  thread_.join();
}

void Waiting::show() {
  std::unique_lock lock(mutex_);
  bool shown = false;
  for (int seconds = 1; !ended_.wait_for(lock, std::chrono::seconds(1), [this] { return end_; }); ++seconds) {
    if (seconds < kQuietSeconds) continue;
    std::fprintf(stderr, "\r\033[K%s", waitingText(what_, seconds, columnsOf(stderr)).c_str());
    std::fflush(stderr);
    shown = true;
  }
  if (shown) std::fputs("\r\033[K", stderr);
}

}  // namespace presa::terminal
