#include "apps/robot_reader/trial.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

namespace presa::robot {
namespace {

constexpr rlim_t kSeconds = 120;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr rlim_t kMemory = RLIM_INFINITY;  // sanitizers reserve terabytes of shadow memory
#else
constexpr rlim_t kMemory = rlim_t{8} << 30U;
#endif

void limit(int resource, rlim_t value) {
  const rlimit wanted{value, value};
  setrlimit(static_cast<__rlimit_resource>(resource), &wanted);
}

[[noreturn]] void child(int to, const std::function<std::string()>& work) {
  // the words of a crash would hide the finding that names the file
  if (const int null = open("/dev/null", O_WRONLY); null >= 0) dup2(null, STDERR_FILENO);
  for (const int number : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGXCPU, SIGINT, SIGTERM, SIGHUP})
    std::signal(number, SIG_DFL);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, kSeconds);
  limit(RLIMIT_DATA, kMemory);
  const std::string said = work();
  const char end = '\0';  // whoever finishes says so, even if it says nothing else
  const bool whole =
      ::write(to, said.data(), said.size()) == static_cast<ssize_t>(said.size()) && ::write(to, &end, 1) == 1;
  _exit(whole ? 0 : 1);  // run neither destructors nor exit handlers of the parent
}

std::string received(int from) {
  std::string said;
  std::array<char, 4096> part{};
  for (;;) {
    const ssize_t got = ::read(from, part.data(), part.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return said;
    said.append(part.data(), static_cast<std::size_t>(got));
  }
}

}  // namespace

std::string trial(const std::function<std::string()>& work) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) return std::string("no pipe for the reader: ") + std::strerror(errno);
  const pid_t process = fork();
  if (process == 0) {
    close(ends[0]);
    child(ends[1], work);
  }
  close(ends[1]);
  std::string said = process > 0 ? received(ends[0]) : "";
  close(ends[0]);
  int status = 0;
  while (process > 0 && waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  if (!said.empty() && said.back() == '\0') {
    said.pop_back();
    return said;
  }
  if (process <= 0) return std::string("no process for the reader: ") + std::strerror(errno);
  if (!WIFSIGNALED(status)) return "the reader gave up";
  if (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL) return "the reader did not finish in time";
  return std::string("the reader crashed on it (") + strsignal(WTERMSIG(status)) + ")";
}

}  // namespace presa::robot
