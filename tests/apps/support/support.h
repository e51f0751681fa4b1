#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "apps/common/terminal_run.h"

namespace presa::test {

inline std::string source(const std::string& path) { return std::string(PRESA_SOURCE_DIR) + "/" + path; }

/// Path in a temporary folder of this process, which is removed at its end.
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
/// Whether there is no browser to look at pages with; config/packages.txt has one for the tests.
bool browserMissing();

/// The shipped cube, its text changed by `edit`, as a file in the scratch folder.
std::string cubeWith(const std::string& name, const std::function<void(std::string&)>& edit);
/// `presa VERB` for a file of cubeWith, with the shipped rig and also the plug-ins of the tests.
Outcome withTestPlugins(const std::string& verb, const std::string& scene, const std::string& more = {});

}  // namespace presa::test
