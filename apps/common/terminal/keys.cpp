#include "apps/common/terminal/keys.h"

#include <poll.h>
#include <unistd.h>

#include <atomic>

namespace presa::terminal {

namespace {

// global, so that a signal handler can reach it
std::atomic<bool> taken{false};
termios as_it_was{};

}  // namespace

Keys::Keys() {
  termios now{};
  // the system stops a background program that changes the terminal
  if (::isatty(STDIN_FILENO) == 0 || ::tcgetpgrp(STDIN_FILENO) != ::getpgrp() || ::tcgetattr(STDIN_FILENO, &now) != 0)
    return;
  before_ = as_it_was = now;
  taken = true;
  now.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  now.c_cc[VMIN] = 0;
  now.c_cc[VTIME] = 0;
  ::tcsetattr(STDIN_FILENO, TCSANOW, &now);
}

Keys::~Keys() {
  if (!before_) return;
  taken = false;
  ::tcsetattr(STDIN_FILENO, TCSANOW, &*before_);
}

void Keys::giveBack() noexcept {
  if (taken) ::tcsetattr(STDIN_FILENO, TCSANOW, &as_it_was);
}

char Keys::next(int ms) const {
  if (!before_) return 0;
  pollfd waiting{STDIN_FILENO, POLLIN, 0};
  char pressed = 0;
  if (::poll(&waiting, 1, ms) <= 0 || ::read(STDIN_FILENO, &pressed, 1) != 1) return 0;
  return pressed;
}

}  // namespace presa::terminal
