#pragma once
#include <functional>
#include <string>
#include <vector>

#include "apps/common/options/command_line.h"

namespace presa {

/// The main() of Presa's programs. `presa` is the one command that people type; a command that belongs to another app is a
/// program of its own beside it, named after it with dashes: `presa experiment run` starts `presa-experiment run`,
/// `presa device faults` starts `presa-device-faults`. A program that somebody else puts there is found in the same way.
struct Program {
  /// The words of the command that this program is: {"device", "faults"}; none for `presa` itself.
  std::vector<std::string> words;
  /// Declares its commands; the action of each leaves its exit status in `status`.
  std::function<void(Command presa, int& status)> declare;
  std::string footer;  ///< of the help of `presa` itself
};

/// Parses, runs, and turns what is thrown into an exit status. `--summary` prints the line that stands in `presa --help`.
int runProgram(int argc, char** argv, const Program& program);

}  // namespace presa
