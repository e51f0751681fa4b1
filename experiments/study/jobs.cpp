#include "experiments/study/jobs.h"

#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <thread>

#include "framework/core/schedule/clock.h"

namespace presa {
namespace {

constexpr int kThrewStatus = 3;
constexpr int kPollMs = 100;

struct Running {
  std::size_t index = 0;
  pid_t process = -1;
  int pipe = -1;
  std::int64_t begin = 0;
  bool timed_out = false;
  std::string text;
};

[[noreturn]] void runInChild(std::size_t index, const std::function<std::string(std::size_t)>& job, int pipe) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_IGN);  // the parent handles signals
  std::string text;
  int status = 0;
  try {
    text = job(index);
  } catch (const std::exception& error) {
    text = error.what();
    status = kThrewStatus;
  }
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t n = ::write(pipe, text.data() + sent, text.size() - sent);
    if (n <= 0) break;
    sent += static_cast<std::size_t>(n);
  }
  std::fflush(nullptr);
  ::_exit(status);  // skip the destructors of the parent's objects
}

Running start(std::size_t index, const std::function<std::string(std::size_t)>& job) {
  int ends[2];
  if (::pipe(ends) != 0) throw std::runtime_error(std::string("no pipe for a job: ") + std::strerror(errno));
  std::fflush(nullptr);
  const pid_t process = ::fork();
  if (process < 0) throw std::runtime_error(std::string("no process for a job: ") + std::strerror(errno));
  if (process == 0) {
    ::close(ends[0]);
    runInChild(index, job, ends[1]);
  }
  ::close(ends[1]);
  return {index, process, ends[0], monotonicNs(), false, {}};
}

double seconds(const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); }

JobResult finish(Running& job, bool stopped) {
  int status = 0;
  rusage used{};
  ::wait4(job.process, &status, 0, &used);
  ::close(job.pipe);
  JobResult result;
  result.text = std::move(job.text);
  result.seconds = static_cast<double>(monotonicNs() - job.begin) * 1e-9;
  result.cpu_seconds = seconds(used.ru_utime) + seconds(used.ru_stime);
  if (stopped) {
    result.outcome = JobResult::Outcome::kNotRun;
  } else if (job.timed_out) {
    result.outcome = JobResult::Outcome::kTimedOut;
  } else if (WIFSIGNALED(status)) {
    result.outcome = JobResult::Outcome::kCrashed;
    result.text = ::strsignal(WTERMSIG(status));
    result.killed = WTERMSIG(status) == SIGKILL;
  } else if (WEXITSTATUS(status) == kThrewStatus) {
    result.outcome = JobResult::Outcome::kThrew;
  } else if (WEXITSTATUS(status) != 0) {
    result.outcome = JobResult::Outcome::kCrashed;
    result.text = "exit status " + std::to_string(WEXITSTATUS(status));
  } else {
    result.outcome = JobResult::Outcome::kDone;
  }
  return result;
}

/// True when the job has closed its pipe, that is, has ended.
bool readSome(Running& job) {
  char buffer[1 << 16];
  const ssize_t n = ::read(job.pipe, buffer, sizeof buffer);
  if (n > 0) job.text.append(buffer, static_cast<std::size_t>(n));
  return n == 0 || (n < 0 && errno != EINTR);
}

}  // namespace

std::vector<JobResult> runJobs(std::size_t count, const std::function<std::string(std::size_t)>& job,
                               const JobOptions& options) {
  const auto processors = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const auto workers = static_cast<std::size_t>(options.workers > 0 ? options.workers : processors);
  std::vector<JobResult> results(count);
  std::vector<Running> running;
  bool stopped = false;
  for (std::size_t next = 0; next < count || !running.empty();) {
    stopped = stopped || (options.stop && options.stop());
    while (!stopped && next < count && running.size() < workers) running.push_back(start(next++, job));
    if (stopped) {
      for (const Running& r : running) ::kill(r.process, SIGKILL);
    }
    if (running.empty()) break;
    std::vector<pollfd> waiting;
    for (const Running& r : running) waiting.push_back({r.pipe, POLLIN, 0});
    ::poll(waiting.data(), waiting.size(), kPollMs);
    for (std::size_t i = running.size(); i-- > 0;) {
      Running& r = running[i];
      const bool late = static_cast<double>(monotonicNs() - r.begin) * 1e-9 > options.time_limit;
      if (late && !r.timed_out) {
        r.timed_out = true;
        ::kill(r.process, SIGKILL);
      }
      if (waiting[i].revents == 0 || !readSome(r)) continue;
      results[r.index] = finish(r, stopped);
      if (options.on_done) options.on_done(r.index, results[r.index]);
      running.erase(running.begin() + static_cast<std::ptrdiff_t>(i));
    }
    if (options.on_wait) options.on_wait();
  }
  return results;
}

}  // namespace presa
