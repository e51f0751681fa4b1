#include "apps/common/terminal/interruption.h"

#include <unistd.h>

#include "apps/common/terminal/prompt_end.h"

namespace presa::terminal {
namespace {

volatile std::sig_atomic_t signal_came = 0;
extern "C" void noteSignal(int) {
  static constexpr char kAnswer[] = "\nstopping\n";  // the step that runs now may take a while
  if (signal_came == 0) (void)!::write(STDERR_FILENO, kAnswer, sizeof kAnswer - 1);
  signal_came = 1;
  PromptEnd::ask();
}

/// Clears signals that came before.
auto noteAnew() {
  signal_came = 0;
  return noteSignal;
}

}  // namespace

EndSignals::EndSignals(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    sigaction(kSignals[i], &action, &old_[i]);
    if (kSignals[i] == SIGHUP && old_[i].sa_handler == SIG_IGN) sigaction(SIGHUP, &old_[i], nullptr);
  }
}

EndSignals::~EndSignals() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &old_[i], nullptr);
}

Interruption::Interruption() : signals_(noteAnew()) {}

bool Interruption::came() noexcept { return signal_came != 0; }

}  // namespace presa::terminal
