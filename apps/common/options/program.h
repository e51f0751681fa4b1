#pragma once
#include <functional>
#include <string>
#include <vector>

#include "apps/common/options/command_line.h"

namespace presa {

/// The main() of Presa's programs. Users type only `presa`; many commands are programs of their own in the same folder,
/// named after the command with dashes: `presa experiment run` starts `presa-experiment run`, `presa
/// device faults` starts `presa-device-faults`. Other programs in this folder with such names are found in the same
/// way.
struct Program {
  /// The words of this program's command: {"device", "faults"}; none for `presa` itself.
  std::vector<std::string> words;
  /// Declares its commands; the action of each command stores its exit status in `status`.
  std::function<void(Command presa, int& status)> declare;
  std::string footer;  ///< last lines of the help, for `presa` itself
};

/// Parses, runs, and turns exceptions into an exit status. `--summary` prints the program's line of `presa --help`.
int runProgram(int argc, char** argv, const Program& program);

}  // namespace presa
