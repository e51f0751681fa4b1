#pragma once
#include <csignal>

namespace presa::terminal {

/// While it lives, Ctrl-C and SIGTERM are noted instead of ending the process. Thread: main; one at a time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  static bool came() noexcept;

 private:
  struct sigaction old_int_ {
  }, old_term_{};
};

}  // namespace presa::terminal
