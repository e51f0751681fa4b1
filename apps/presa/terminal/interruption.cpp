#include "apps/presa/terminal/interruption.h"

namespace presa::terminal {
namespace {

volatile std::sig_atomic_t signal_came = 0;
extern "C" void noteSignal(int) { signal_came = 1; }

}  // namespace

Interruption::Interruption() {
  signal_came = 0;
  struct sigaction action {};
  action.sa_handler = noteSignal;
  sigaction(SIGINT, &action, &old_int_);
  sigaction(SIGTERM, &action, &old_term_);
}

Interruption::~Interruption() {
  sigaction(SIGINT, &old_int_, nullptr);
  sigaction(SIGTERM, &old_term_, nullptr);
}

bool Interruption::came() noexcept { return signal_came != 0; }

}  // namespace presa::terminal
