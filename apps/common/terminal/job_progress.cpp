#include "apps/common/terminal/job_progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "apps/common/terminal/text.h"
#include "framework/core/schedule/clock.h"

namespace presa::terminal {
namespace {

std::string clockText(double seconds) {
  const int whole = static_cast<int>(seconds + 0.5);
  return whole < 60 ? format("%d s", whole) : format("%d min %02d s", whole / 60, whole % 60);
}

}  // namespace

JobProgress::JobProgress(std::size_t jobs)
    : jobs_(jobs), terminal_(::isatty(STDERR_FILENO) != 0), start_ns_(monotonicNs()) {
  next_ns_ = start_ns_ + 2'000'000'000;
}

void JobProgress::done(const std::string& what) {
  ++done_;
  last_ = what;
  show();
}

void JobProgress::expect(double seconds_left) {
  expected_end_ = static_cast<double>(monotonicNs() - start_ns_) * 1e-9 + seconds_left;
}

void JobProgress::show() {
  const std::int64_t now = monotonicNs();
  const std::size_t tenths = jobs_ > 0 ? 10 * done_ / jobs_ : 0;
  if (now < next_ns_ || (!terminal_ && tenths == said_tenths_)) return;
  said_tenths_ = tenths;
  next_ns_ = now + (terminal_ ? 100'000'000 : 2'000'000'000);
  const double elapsed = static_cast<double>(now - start_ns_) * 1e-9;
  std::string line = format("%zu of %zu", done_, jobs_);
  if (done_ > 0) {
    const double alike = elapsed * static_cast<double>(jobs_ - done_) / static_cast<double>(done_);
    const double left = expected_end_ >= 0 ? std::max(1.0, expected_end_ - elapsed) : alike;
    line += ", about " + clockText(left) + " left  " + last_;
  }
  std::fprintf(stderr, terminal_ ? "\r\033[K%s" : "%s\n", line.c_str());
  std::fflush(stderr);
  shown_ = true;
}

void JobProgress::finish() {
  if (shown_ && terminal_) std::fputs("\r\033[K", stderr);
  shown_ = false;
}

}  // namespace presa::terminal
