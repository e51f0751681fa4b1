#pragma once
#include <string>

namespace presa::shell {

/// The text as one word of a POSIX shell.
std::string quoted(const std::string& text);

/// What a command printed, and its exit status; -1: it could not be run, or a signal ended it.
struct Outcome {
  int status = -1;
  std::string out, err;
};
/// Runs a command line of the shell and waits for it. Ctrl-C at the terminal does not reach it. Thread: main.
Outcome run(const std::string& command);

}  // namespace presa::shell
