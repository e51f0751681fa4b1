#pragma once
#include <string>

namespace presa::shell {

/// The text as one word of a POSIX shell.
std::string quoted(const std::string& text);

/// What a command printed on stdout and stderr, and its exit status; -1: it could not be run, or a signal ended it.
struct Outcome {
  int status = -1;
  std::string text;
};
/// Runs a command line of the shell and waits for it. Thread: main.
Outcome run(const std::string& command);

}  // namespace presa::shell
