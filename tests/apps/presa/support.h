#pragma once
#include <memory>
#include <string>
#include <vector>

#include "apps/common/terminal_run.h"

namespace presa::test {

inline std::string source(const std::string& path) { return std::string(PRESA_SOURCE_DIR) + "/" + path; }

/// Path in a temporary folder of this process, which is removed when the tests pass.
std::string scratch(const std::string& name);

/// A lockstep run of a shipped scene without terminal output. Throws InputError.
std::unique_ptr<TerminalRun> runScene(const std::string& scene, const std::vector<std::string>& sets = {},
                                      RunOptions options = {}, double trace_rate = 1000);

/// Result of the built program in a separate process.
struct Outcome {
  int status = -1;  ///< exit status
  std::string out, err;
};
Outcome shell(const std::string& command);
Outcome presa(const std::string& arguments);

}  // namespace presa::test
