#include "experiments/study/jobs.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <limits>
#include <stdexcept>
#include <thread>

#include "framework/core/schedule/clock.h"

namespace presa {
namespace {

constexpr int kThrewStatus = 3;
constexpr int kPollMs = 100;
constexpr std::size_t kNoJob = std::numeric_limits<std::size_t>::max();

using Job = std::function<std::string(std::size_t)>;

struct Pipe {
  int read = -1, write = -1;
};
Pipe makePipe() {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error(std::string("no pipe for jobs: ") + std::strerror(errno));
  return {ends[0], ends[1]};
}

/// Forks. The child ends with its parent and leaves signals to it.
pid_t forkChild() {
  const pid_t parent = ::getpid();
  std::fflush(nullptr);
  const pid_t process = ::fork();
  if (process < 0) throw std::runtime_error(std::string("no process for a job: ") + std::strerror(errno));
  if (process > 0) return process;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // it ended before the line above
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_IGN);
  return 0;
}

/// False: nobody reads any more.
bool send(int pipe, const void* data, std::size_t size) {
  const char* bytes = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t n = ::write(pipe, bytes, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    bytes += n;
    size -= static_cast<std::size_t>(n);
  }
  return true;
}

[[noreturn]] void runJob(std::size_t index, const Job& job, int pipe) {
  std::string text;
  int status = 0;
  try {
    text = job(index);
  } catch (const std::exception& error) {
    text = error.what();
    status = kThrewStatus;
  }
  send(pipe, text.data(), text.size());
  std::fflush(nullptr);
  ::_exit(status);  // skip the destructors of the parent's objects
}

struct Running {
  std::size_t index = 0;
  pid_t process = -1;
  int pipe = -1;
  std::int64_t begin = 0;
  bool timed_out = false;
  std::string text;
};

double seconds(const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); }

JobResult finish(Running& job) {
  int status = 0;
  rusage used{};
  ::wait4(job.process, &status, 0, &used);
  ::close(job.pipe);
  JobResult result;
  result.text = std::move(job.text);
  result.seconds = static_cast<double>(monotonicNs() - job.begin) * 1e-9;
  result.cpu_seconds = seconds(used.ru_utime) + seconds(used.ru_stime);
  if (job.timed_out) {
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
  char buffer[1 << 12];
  const ssize_t n = ::read(job.pipe, buffer, sizeof buffer);
  if (n > 0) job.text.append(buffer, static_cast<std::size_t>(n));
  return n == 0 || (n < 0 && errno != EINTR);
}

/// A result on its way from the nursery; its text follows. kNoJob: why no more jobs can be started.
struct Report {
  std::size_t index = kNoJob, text = 0;
  JobResult::Outcome outcome = JobResult::Outcome::kNotRun;
  bool killed = false;
  double seconds = 0, cpu_seconds = 0;
};

/// The process that forks all jobs. After a fork each page that is written is copied first, with the other processors
/// told of it: the nursery writes a few pages, its parent all that a result changes.
class Nursery {
 public:
  Nursery(std::size_t count, const Job& job, const JobOptions& options, std::size_t workers, int reports)
      : count_(count), job_(job), options_(options), workers_(workers), reports_(reports) {
    running_.reserve(workers);
    waiting_.reserve(workers);
  }

  [[noreturn]] void run() {
    std::signal(SIGPIPE, SIG_IGN);  // the next job's process may be killed before it has its index
    try {
      runAll();
    } catch (const std::exception& error) {
      report(kNoJob, {.text = error.what()});
    }
    ::_exit(0);
  }

 private:
  void runAll() {
    for (std::size_t next = 0; next < count_ || !running_.empty();) {
      while (next < count_ && running_.size() < workers_) start(next++);
      if (next < count_ && next_.process < 0) prepare();  // beside the running job
      waiting_.clear();
      for (const Running& r : running_) waiting_.push_back({r.pipe, POLLIN, 0});
      ::poll(waiting_.data(), waiting_.size(), kPollMs);
      for (std::size_t i = running_.size(); i-- > 0;) {
        endLate(running_[i]);
        if (waiting_[i].revents == 0 || !readSome(running_[i])) continue;
        report(running_[i].index, finish(running_[i]));
        running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(i));
      }
    }
  }
  /// Forks the process of the next job, which waits for its index.
  void prepare() {
    const Pipe orders = makePipe(), text = makePipe();
    const pid_t process = forkChild();
    if (process == 0) {
      std::size_t index = 0;
      std::signal(SIGPIPE, SIG_DFL);
      if (::read(orders.read, &index, sizeof index) != sizeof index) ::_exit(0);
      runJob(index, job_, text.write);
    }
    ::close(orders.read);
    ::close(text.write);
    next_ = {process, orders.write, text.read};
  }
  void start(std::size_t index) {
    if (next_.process < 0) prepare();
    send(next_.orders, &index, sizeof index);
    ::close(next_.orders);
    running_.push_back({index, next_.process, next_.text, monotonicNs(), false, {}});
    next_ = {};
  }
  void endLate(Running& r) const {
    const bool late = static_cast<double>(monotonicNs() - r.begin) * 1e-9 > options_.time_limit;
    if (!late || r.timed_out) return;
    r.timed_out = true;
    ::kill(r.process, SIGKILL);
  }
  void report(std::size_t index, const JobResult& result) const {
    const Report head{index, result.text.size(), result.outcome, result.killed, result.seconds, result.cpu_seconds};
    if (!send(reports_, &head, sizeof head) || !send(reports_, result.text.data(), result.text.size())) ::_exit(1);
  }

  std::size_t count_;
  const Job& job_;
  const JobOptions& options_;
  std::size_t workers_;
  int reports_;
  struct {
    pid_t process = -1;
    int orders = -1, text = -1;
  } next_;
  std::vector<Running> running_;
  std::vector<pollfd> waiting_;
};

/// The parent's end of a nursery. Its end is the end of all jobs.
class Nursed {
 public:
  Nursed(std::size_t count, const Job& job, const JobOptions& options, std::size_t workers) {
    const Pipe reports = makePipe();
    pipe_ = reports.read;
    process_ = forkChild();
    if (process_ == 0) Nursery(count, job, options, workers, reports.write).run();
    ::close(reports.write);
  }
  ~Nursed() {
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
    char rest[1 << 12];
    while (receive(rest, sizeof rest)) {  // each job has the pipe open until it has ended
    }
    ::close(pipe_);
  }
  Nursed(const Nursed&) = delete;
  Nursed& operator=(const Nursed&) = delete;

  bool hasReport() const {
    pollfd waiting{pipe_, POLLIN, 0};
    return ::poll(&waiting, 1, kPollMs) > 0;
  }
  /// Waits for a report. Throws when no more can come.
  std::size_t receive(JobResult& result) const {
    Report head;
    std::string text;
    bool whole = receive(&head, sizeof head);
    if (whole) text.resize(head.text);
    whole = whole && receive(text.data(), text.size());
    if (!whole) throw std::runtime_error("the process that starts jobs was killed from outside");
    if (head.index == kNoJob) throw std::runtime_error(text);
    result = {head.outcome, head.killed, std::move(text), head.seconds, head.cpu_seconds};
    return head.index;
  }

 private:
  /// False: the pipe has no more writer.
  bool receive(void* data, std::size_t size) const {
    char* bytes = static_cast<char*>(data);
    while (size > 0) {
      const ssize_t n = ::read(pipe_, bytes, size);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) return false;
      bytes += n;
      size -= static_cast<std::size_t>(n);
    }
    return true;
  }

  int pipe_ = -1;
  pid_t process_ = -1;
};

}  // namespace

std::vector<JobResult> runJobs(std::size_t count, const Job& job, const JobOptions& options) {
  std::vector<JobResult> results(count);
  const auto stopped = [&] { return options.stop && options.stop(); };
  if (count == 0 || stopped()) return results;
  const auto processors = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const Nursed nursery(count, job, options,
                       static_cast<std::size_t>(options.workers > 0 ? options.workers : processors));
  for (std::size_t ended = 0; ended < count && !stopped();) {
    if (nursery.hasReport()) {
      JobResult result;
      const std::size_t index = nursery.receive(result);
      results[index] = std::move(result);
      ++ended;
      if (options.on_done) options.on_done(index, results[index]);
    }
    if (options.on_wait) options.on_wait();
  }
  return results;
}

}  // namespace presa
