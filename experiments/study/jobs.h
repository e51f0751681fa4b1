#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace presa {

/// Result of one job.
struct JobResult {
  enum class Outcome { kDone, kThrew, kCrashed, kTimedOut, kNotRun };
  Outcome outcome = Outcome::kNotRun;
  bool killed = false;  ///< by SIGKILL from outside, such as for want of memory
  std::string text;     ///< the return value; the message for kThrew, the signal name for kCrashed
  double seconds = 0;   ///< wall time
  double cpu_seconds = 0;
};

struct JobOptions {
  int workers = 0;               ///< processes at a time; 0: one per processor
  double time_limit = 600;       ///< per job [s]
  std::function<bool()> stop{};  ///< polled; true starts no more jobs and ends the running ones
  /// Called on the main thread for each job, in order of completion.
  std::function<void(std::size_t index, const JobResult& result)> on_done{};
  std::function<void()> on_wait{};  ///< called a few times per second while jobs run, for progress output
};

/// Runs jobs 0 … count-1, each in its own process, and returns their results by index. A job that throws, crashes or
/// times out gives a result and does not affect the others. Jobs are forks of a fork of this process, as it is now: call
/// this while it has a single thread. They end with it. Throws std::runtime_error when no more jobs can be started.
std::vector<JobResult> runJobs(std::size_t count, const std::function<std::string(std::size_t)>& job,
                               const JobOptions& options = {});

}  // namespace presa
