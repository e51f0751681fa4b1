#include "tests/apps/support/support.h"

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "apps/common/file_text.h"
#include "apps/common/scratch_folder.h"

namespace presa::test {

std::string scratch(const std::string& name) {
  static const ScratchFolder folder;
  return folder.file(name);
}

std::unique_ptr<TerminalRun> runScene(const std::string& scene, const std::vector<std::string>& sets,
                                      RunOptions options, double trace_rate) {
  Diagnostics diagnostics;
  if (options.duration == RunOptions{}.duration) options.duration = 0;  // run to the end of the script
  Loaded loaded = loadWorld({source(scene), "", sets}, options, diagnostics);
  if (diagnostics.hasErrors()) throw InputError(diagnostics);
  auto run = std::make_unique<TerminalRun>(
      std::move(loaded), TerminalRun::Settings{.trace_rate = trace_rate, .quiet = true, .command = ""});
  run->execute();
  return run;
}

Outcome shell(const std::string& command) {
  const std::string out = scratch("stdout"), err = scratch("stderr");
  const int status = std::system((command + " >" + out + " 2>" + err).c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contentsOf(out), contentsOf(err)};
}

bool browserMissing() { return shell("command -v chromium").status != 0; }

Outcome presa(const std::string& arguments) { return shell(std::string(PRESA_BINARY_DIR) + "/bin/presa " + arguments); }

std::string cubeWith(const std::string& name, const std::function<void(std::string&)>& edit) {
  std::ifstream in(source("config/scenes/cube.xml"));
  std::string xml{std::istreambuf_iterator<char>(in), {}};
  edit(xml);
  const std::string file = scratch(name);
  std::ofstream(file) << xml;
  return file;
}

Outcome withTestPlugins(const std::string& verb, const std::string& scene, const std::string& more) {
  return shell("PRESA_PLUGIN_PATH=" PRESA_BINARY_DIR "/tests/plugins " PRESA_BINARY_DIR "/bin/presa " + verb + " " +
               scene + " --rig " + source("config/rigs/pinch_cube.xml") + " --allow-folder " + source("config") + more);
}

}  // namespace presa::test
