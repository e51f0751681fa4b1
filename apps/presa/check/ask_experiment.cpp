#include "apps/presa/check/ask_experiment.h"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace presa::check {
namespace {

/// Runs a program and returns what it wrote to stdout.
std::string answerOf(const std::string& program, std::vector<std::string> words) {
  std::array<int, 2> pipe{};
  if (::pipe(pipe.data()) != 0) throw std::runtime_error("no pipe for " + program);
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(pipe[1], STDOUT_FILENO);
    ::close(pipe[0]);
    ::close(pipe[1]);
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    ::execv(program.c_str(), argv.data());
    ::_exit(127);
  }
  ::close(pipe[1]);
  std::string answer;
  std::array<char, 4096> part{};
  for (ssize_t n = 0; (n = ::read(pipe[0], part.data(), part.size())) > 0;)
    answer.append(part.data(), static_cast<std::size_t>(n));
  ::close(pipe[0]);
  int status = 0;
  if (child < 0 || ::waitpid(child, &status, 0) < 0) throw std::runtime_error(program + " cannot be started");
  return answer;
}

}  // namespace

nlohmann::json askExperiment(const std::string& file, const std::string& rig, const std::string& format) {
  std::error_code unknown;
  const std::string program =
      (std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path() / "presa-experiment").string();
  std::vector<std::string> words{"presa", "check", file, "--report", format};
  if (!rig.empty()) words.insert(words.end(), {"--rig", rig});
  const auto answer = nlohmann::json::parse(answerOf(program, std::move(words)), nullptr, false);
  if (answer.is_discarded()) throw std::runtime_error(program + " did not say what is wrong with " + file);
  return answer;
}

}  // namespace presa::check
