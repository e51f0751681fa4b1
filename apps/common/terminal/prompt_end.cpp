#include "apps/common/terminal/prompt_end.h"

#include <unistd.h>

#include <atomic>
#include <csignal>

#include "apps/common/terminal/keys.h"
#include "framework/core/schedule/clock.h"

namespace presa::terminal {
namespace {

constexpr std::int64_t kFadeNs = 40'000'000;  // wall-clock time for the fade of a run in virtual time
constexpr std::int64_t kStuckNs = 65'000'000;
// processor time of all threads together, which sleep for most of the fade
constexpr std::int64_t kStuckLiveNs = 300'000'000;
constexpr int kInterrupted = 130;

std::atomic<PromptEnd*> current{nullptr};

extern "C" void leaveNow(int) {
  static constexpr char kWords[] =
      "\npresa: stopped during a long step: files contain only the data written before it\n";
  Keys::giveBack();
  if (::isatty(STDERR_FILENO) != 0) (void)!::write(STDERR_FILENO, kWords, sizeof kWords - 1);
  ::_exit(kInterrupted);
}

}  // namespace

// The timer counts processor time: on a busy machine, a run that is about to end must not be taken for stuck.
PromptEnd::PromptEnd(RunControl& control, bool realtime) : control_(control), realtime_(realtime) {
  struct sigaction action {};
  action.sa_handler = leaveNow;
  sigaction(SIGALRM, &action, nullptr);
  sigevent event{};
  event.sigev_notify = SIGEV_SIGNAL;
  event.sigev_signo = SIGALRM;
  has_timer_ = timer_create(realtime ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_THREAD_CPUTIME_ID, &event, &timer_) == 0;
  current = this;
}

PromptEnd::~PromptEnd() {
  current = nullptr;
  if (has_timer_) timer_delete(timer_);
}

void PromptEnd::ask() noexcept {
  PromptEnd* const run = current.load();
  if (run == nullptr) return;
  RunControl& control = run->control_;
  if (!run->realtime_ && control.leave_by_ns.load() == RunControl::kNever)
    control.leave_by_ns = monotonicNs() + kFadeNs;
  control.stop_requested = true;
  if (!run->has_timer_) return;
  itimerspec now{};
  timer_gettime(run->timer_, &now);
  if (now.it_value.tv_sec != 0 || now.it_value.tv_nsec != 0) return;  // the timer already runs
  itimerspec once{};
  once.it_value.tv_nsec = run->realtime_ ? kStuckLiveNs : kStuckNs;
  timer_settime(run->timer_, 0, &once, nullptr);
}

}  // namespace presa::terminal
