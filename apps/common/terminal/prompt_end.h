#pragma once
#include <ctime>

#include "framework/core/schedule/executor.h"

namespace presa::terminal {

/// While it lives, around Executor::run: a run that a signal stops ends within 100 ms. Forces fade first, in virtual time for at
/// most 50 ms of the clock. A run that is deep in one step then, and cannot look up, ends where it stands: the process leaves with
/// status 130, and files hold what a kill leaves of them (all up to the last flush, every record of a session).
/// Thread: that of the executor; one at a time.
class PromptEnd {
 public:
  PromptEnd(RunControl& control, bool realtime);
  ~PromptEnd();
  PromptEnd(const PromptEnd&) = delete;
  PromptEnd& operator=(const PromptEnd&) = delete;

  /// From the signal's handler: asks the run that goes on, if one does, to stop.
  static void ask() noexcept;

 private:
  RunControl& control_;
  bool realtime_;
  timer_t timer_{};
  bool has_timer_ = false;
};

}  // namespace presa::terminal
