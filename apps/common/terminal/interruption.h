#pragma once
#include <array>
#include <csignal>

namespace presa::terminal {

/// During its lifetime, Ctrl-C, SIGTERM and SIGHUP call `handler` instead of ending the process; an ignored SIGHUP
/// stays ignored (nohup).
/// Thread: main.
class EndSignals {
 public:
  explicit EndSignals(void (*handler)(int));
  ~EndSignals();
  EndSignals(const EndSignals&) = delete;
  EndSignals& operator=(const EndSignals&) = delete;

 private:
  static constexpr std::array<int, 3> kSignals{SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, 3> old_{};
};

/// During its lifetime, these signals are noted instead of ending the process, and the first is answered on stderr at
/// once; a current run is asked to stop (PromptEnd).
/// Thread: main; one at a time.
class Interruption {
 public:
  Interruption();
  static bool came() noexcept;

 private:
  EndSignals signals_;
};

}  // namespace presa::terminal
