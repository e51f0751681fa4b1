#pragma once
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "framework/core/state/contact_exchange.h"

namespace presa {

/// The current state of a run, as plain values.
struct LiveStatus {
  struct FingerStatus {
    std::string name;
    ContactMode mode = ContactMode::kNone;
    double normal_force = 0;  ///< [N]
  };
  double time = 0;      ///< simulated [s]
  double duration = 0;  ///< simulated [s]; not finite or 0: no planned end
  bool realtime = false;
  double wall_seconds = 0;         ///< since the start
  std::uint64_t haptic_ticks = 0;  ///< since the start
  std::uint64_t haptic_missed = 0;
  std::uint32_t losses = 0;  ///< coverage_lost and pop_through together (losses.h)
  std::string phase;         ///< of a scripted motion, may be empty
  std::vector<FingerStatus> fingers;
};

/// The status as one line of at most `columns` characters: bar, times, phase, fingers, rate. Parts that do not fit
/// are left out from the right; colour adds no width. `rate` is the achieved haptic rate [Hz] in real time and
/// simulated seconds per wall second in lockstep.
std::string statusText(const LiveStatus& status, double rate, std::size_t columns, bool color);

/// Shows a run on stderr: one line refreshed ten times a second on a terminal, a plain line every two seconds
/// elsewhere. Colour only on a terminal and when NO_COLOR is unset. Thread: main.
class StatusLine {
 public:
  explicit StatusLine(bool quiet);
  ~StatusLine();
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  /// True when it is time for the next show(); cheap to call often.
  bool due() const;
  void show(const LiveStatus& status);
  /// Prints a line above the status line.
  void note(const std::string& text);
  /// Removes the refreshed line. Do not call show() afterwards.
  void finish();

 private:
  void clear();
  double recentRate(const LiveStatus& status);

  bool quiet_;
  bool terminal_;
  bool color_;
  bool shown_ = false;
  std::int64_t next_ns_ = 0;
  // the rate shown is that since the last line, not the mean of the whole run
  double last_wall_ = 0, last_time_ = 0;
  std::uint64_t last_ticks_ = 0;
};

/// Whether to colour output to this stream: it is a terminal, and NO_COLOR is unset or empty (no-color.org).
bool wantsColor(std::FILE* stream);

}  // namespace presa
