#pragma once
#include <ctime>

#include "framework/core/schedule/executor.h"

namespace presa::terminal {

/// Around Executor::run: a run that a signal stops ends within 100 ms. Forces fade first, in virtual time for at most
/// 40 ms of the clock. If the run is then still in a long step, the process ends in the middle of it with status 130;
/// files then hold the same as after a kill (all data up to the last flush, every record of a session).
/// Thread: that of the executor; one at a time.
class PromptEnd {
 public:
  PromptEnd(RunControl& control, bool realtime);
  ~PromptEnd();
  PromptEnd(const PromptEnd&) = delete;
  PromptEnd& operator=(const PromptEnd&) = delete;

  /// Called by the signal handler: asks the current run, if there is one, to stop.
  static void ask() noexcept;

 private:
  RunControl& control_;
  bool realtime_;
  timer_t timer_{};
  bool has_timer_ = false;
};

}  // namespace presa::terminal
