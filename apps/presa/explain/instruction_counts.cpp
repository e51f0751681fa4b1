#include "apps/presa/explain/instruction_counts.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "apps/common/file_text.h"
#include "apps/common/scratch_folder.h"

namespace presa {
namespace {

namespace fs = std::filesystem;

constexpr int kNotFound = 127;

/// Exit status; kNotFound when there is no such program. Output goes to `log`.
int runProgram(const std::vector<std::string>& words, const fs::path& log) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
  pid_t child = 0;
  const int error = ::posix_spawnp(&child, arguments[0], &files, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (error != 0) return kNotFound;
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

std::optional<std::map<std::string, FunctionCost>> countInstructions(const Inputs& inputs, double duration,
                                                                     bool recorded) {
  const ScratchFolder scratch;
  const fs::path counts = scratch.file("callgrind"), log = scratch.file("log");
  std::vector<std::string> words{"valgrind",
                                 "--tool=callgrind",
                                 "--callgrind-out-file=" + counts.string(),
                                 fs::read_symlink("/proc/self/exe").string(),
                                 "run",
                                 inputs.scene,
                                 "--lockstep",
                                 "--quiet",
                                 "--view",
                                 "none",
                                 "--for",
                                 std::to_string(duration)};
  if (recorded) words.insert(words.end(), {"--record", scratch.file("run.h5")});
  if (!inputs.rig.empty()) words.insert(words.end(), {"--rig", inputs.rig});
  for (const std::string& set : inputs.sets) words.insert(words.end(), {"--set", set});
  const int status = runProgram(words, log);
  if (status == kNotFound) return std::nullopt;
  std::ifstream file(counts);
  if (status != 0 && status != 1)  // 1: the run reported a fault, the counts are there all the same
    throw std::runtime_error("valgrind failed (status " + std::to_string(status) + "):\n" + contentsOf(log));
  return readCallgrind(file);
}

std::optional<FunctionCost> costOf(const std::map<std::string, FunctionCost>& costs, const std::string& function) {
  FunctionCost sum;
  for (const auto& [name, cost] : costs) {
    if (!name.starts_with(function) || (name.size() > function.size() && name[function.size()] != '(')) continue;
    if (name.find(")::{lambda") != std::string::npos) continue;  // inside it, and counted with it
    sum.calls += cost.calls;
    sum.instructions += cost.instructions;
  }
  if (sum.calls == 0) return std::nullopt;
  return sum;
}

}  // namespace presa
