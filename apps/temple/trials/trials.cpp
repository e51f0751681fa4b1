#include "apps/temple/trials/trials.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>

#include "apps/common/file_text.h"
#include "apps/common/options/program.h"
#include "apps/common/terminal/job_progress.h"
#include "apps/common/terminal/text.h"
#include "apps/temple/temple_command.h"
#include "experiments/study/jobs.h"
#include "framework/core/diagnostics/refuse.h"

namespace presa::temple {
namespace {

namespace fs = std::filesystem;
using terminal::format;

enum TrialCode { kNoFolder = 815 };

constexpr double kTrialLimit = 3600;  // wall time [s]

std::string fileOf(const TrialsPlan& plan, std::uint64_t seed, const char* ending) {
  return plan.out + format("/seed_%llu", static_cast<unsigned long long>(seed)) + ending;
}

/// Standard output and error, in the order in which they are printed.
void printInto(const std::string& log) {
  const int file = ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0666);
  if (file < 0 || ::dup2(file, STDOUT_FILENO) < 0 || ::dup2(file, STDERR_FILENO) < 0)
    throw std::system_error(errno, std::generic_category(), log + " cannot be written");
}

/// In a process of its own: the visit prints into a file, and its summary is the result.
std::string rebuild(const TrialsPlan& plan, std::uint64_t seed) {
  const std::string log = fileOf(plan, seed, ".log"), summary = fileOf(plan, seed, ".json");
  fs::remove(summary);
  printInto(log);
  std::vector<std::string> words{"presa"};
  const std::vector<std::string> wanted = wordsOf(plan, seed);
  words.insert(words.end(), wanted.begin() + 1, wanted.end());  // its program is `presa temple`
  words.insert(words.end(), {"--view", "none", "--session", "none", "--count", "none", "--summary", summary});
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  const int status = runProgram(static_cast<int>(arguments.size()), arguments.data(),
                                {.words = {"temple"}, .declare = addTemple, .footer = {}});
  if (!fs::exists(summary)) throw std::runtime_error(format("exit status %d, see ", status) + log);
  return contentsOf(summary);
}

Trial trialOfSummary(const std::string& summary) {
  const nlohmann::json all = nlohmann::json::parse(summary);
  Trial trial;
  trial.pieces = all.at("pieces");
  trial.placed = all.at("placed");
  trial.drops = all.at("drops");
  trial.lost = all.at("lost");
  trial.faults = all.at("faults");
  trial.position_error = all.at("worst_position_error_m");
  trial.angle_error = all.at("worst_angle_error_deg");
  trial.simulated = all.at("simulated_s");
  trial.wall = all.at("wall_s");
  return trial;
}

Trial trialOf(std::uint64_t seed, const JobResult& result) {
  using Outcome = JobResult::Outcome;
  Trial trial;
  if (result.outcome == Outcome::kDone) {
    trial = trialOfSummary(result.text);
  } else {
    trial.reason = result.outcome == Outcome::kTimedOut  ? format("no end after %.0f s", kTrialLimit)
                   : result.outcome == Outcome::kCrashed ? "crashed: " + result.text
                                                         : result.text;
  }
  trial.seed = seed;
  return trial;
}

}  // namespace

void makeFolder(const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) refuse(kNoFolder, folder, "the folder cannot be made: " + error.message());
}

std::vector<std::string> wordsOf(const TrialsPlan& plan, std::uint64_t seed) {
  std::vector<std::string> words{"temple", "--auto",  "--lockstep", "--seed", std::to_string(seed),
                                 "--size", plan.size, "--plan",     plan.plan};
  if (plan.limit > 0) words.insert(words.end(), {"--for", format("%.17g", plan.limit)});
  return words;
}

Trials runTrials(const TrialsPlan& plan) {
  std::vector<std::uint64_t> seeds;
  for (std::size_t i = 0; i < static_cast<std::size_t>(plan.seeds); ++i)
    if (!plan.shard || plan.shard->holds(i)) seeds.push_back(plan.first_seed + i);
  terminal::JobProgress progress(seeds.size());
  JobOptions options;
  options.workers = plan.jobs;
  options.time_limit = kTrialLimit;
  options.stop = [&] { return progress.interrupted(); };
  options.on_wait = [&] { progress.show(); };
  options.on_done = [&](std::size_t i, const JobResult&) { progress.done("seed " + std::to_string(seeds[i])); };
  const auto results = runJobs(
      seeds.size(), [&](std::size_t i) { return rebuild(plan, seeds[i]); }, options);
  progress.finish();
  Trials trials{{}, progress.interrupted()};
  for (std::size_t i = 0; i < results.size(); ++i)
    if (results[i].killed && plan.shard)
      throw std::runtime_error("the trial of seed " + std::to_string(seeds[i]) +
                               " was killed from outside: the shard is not finished");
  for (std::size_t i = 0; i < results.size(); ++i)
    if (results[i].outcome != JobResult::Outcome::kNotRun) trials.all.push_back(trialOf(seeds[i], results[i]));
  return trials;
}

}  // namespace presa::temple
