#pragma once
#include <termios.h>

#include <optional>

namespace presa::terminal {

/// During its lifetime, reads keys one by one and without echo; afterwards the terminal is as before. Signals still
/// work: Ctrl-C stops cleanly. Without a terminal on stdin, or in the background, there are no keys. Thread: main.
class Keys {
 public:
  Keys();
  ~Keys();
  Keys(const Keys&) = delete;
  Keys& operator=(const Keys&) = delete;

  bool available() const noexcept { return before_.has_value(); }
  /// Waits up to this time [ms] for the next key; 0: none.
  char next(int ms) const;
  /// Restores the terminal; may be called in the handler of a signal that ends the process.
  static void giveBack() noexcept;

 private:
  std::optional<termios> before_;
};

}  // namespace presa::terminal
