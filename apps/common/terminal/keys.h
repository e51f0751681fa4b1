#pragma once
#include <termios.h>

#include <optional>

namespace presa::terminal {

/// Keys one by one and unseen, while it lives; the terminal is as it was afterwards. Signals stay: Ctrl-C stops cleanly. Without a
/// terminal on stdin, or in the background, there are no keys. Thread: main.
class Keys {
 public:
  Keys();
  ~Keys();
  Keys(const Keys&) = delete;
  Keys& operator=(const Keys&) = delete;

  bool available() const noexcept { return before_.has_value(); }
  /// The next key, waited for at most that long [ms]; 0: none.
  char next(int ms) const;
  /// The terminal as it was, from the handler of a signal that ends the process.
  static void giveBack() noexcept;

 private:
  std::optional<termios> before_;
};

}  // namespace presa::terminal
