#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace presa {

/// What became of one job.
struct JobResult {
  enum class Outcome { kDone, kThrew, kCrashed, kTimedOut, kNotRun };
  Outcome outcome = Outcome::kNotRun;
  std::string text;    ///< what the job returned; of kThrew its message, of kCrashed the signal in words
  double seconds = 0;  ///< wall time
  double cpu_seconds = 0;
};

struct JobOptions {
  int workers = 0;               ///< processes at a time; 0: as many as there are processors
  double time_limit = 600;       ///< of one job [s]
  std::function<bool()> stop{};  ///< asked now and then: true starts no more jobs and ends those that run
  /// Called on the main thread as each job ends, in the order of their ends.
  std::function<void(std::size_t index, const JobResult& result)> on_done{};
  std::function<void()> on_wait{};  ///< called a few times a second while jobs run: progress
};

/// Runs jobs 0 … count-1, each in a process of its own, and returns their results by index. A job that throws, crashes or
/// takes too long is a result, never the end of the others. Call it while the process has no other thread: jobs are forks.
std::vector<JobResult> runJobs(std::size_t count, const std::function<std::string(std::size_t)>& job,
                               const JobOptions& options = {});

}  // namespace presa
