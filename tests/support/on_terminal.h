#pragma once
#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <string>
#include <vector>

namespace presa::test {

/// Runs a program in a pseudo-terminal.
class OnTerminal {
 public:
  explicit OnTerminal(std::vector<std::string> command) {
    std::vector<char*> arguments;
    for (std::string& word : command) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    child_ = forkpty(&terminal_, nullptr, nullptr, nullptr);
    if (child_ == 0) {
      execv(arguments[0], arguments.data());
      _exit(127);
    }
  }
  ~OnTerminal() {
    close(terminal_);
    if (child_ > 0) waitpid(child_, nullptr, 0);
  }
  OnTerminal(const OnTerminal&) = delete;
  OnTerminal& operator=(const OnTerminal&) = delete;

  /// Reads until the text has appeared; false when the program ended, or printed nothing for ten seconds.
  bool says(const std::string& text) {
    for (char bytes[4096]; seen_.find(text) == std::string::npos;) {
      pollfd waiting{terminal_, POLLIN, 0};
      if (poll(&waiting, 1, 10'000) <= 0) return false;
      const ssize_t read = ::read(terminal_, bytes, sizeof bytes);
      if (read <= 0) return false;
      seen_.append(bytes, static_cast<std::size_t>(read));
    }
    return true;
  }
  /// Reads the output for a time [s], so that the program never waits for its reader.
  void listen(double seconds) {
    pollfd waiting{terminal_, POLLIN, 0};
    char bytes[4096];
    if (poll(&waiting, 1, static_cast<int>(1e3 * seconds)) <= 0) return;
    if (const ssize_t read = ::read(terminal_, bytes, sizeof bytes); read > 0)
      seen_.append(bytes, static_cast<std::size_t>(read));
  }
  /// Discards the output so far.
  void forget() { seen_.clear(); }
  void press(char key) { ASSERT_EQ(write(terminal_, &key, 1), 1); }
  int status() {
    while (says("\1never")) {
    }
    int status = -1;
    waitpid(std::exchange(child_, -1), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  pid_t pid() const { return child_; }
  const std::string& seen() const { return seen_; }

 private:
  int terminal_ = -1;
  pid_t child_ = -1;
  std::string seen_;
};

}  // namespace presa::test
