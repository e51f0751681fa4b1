#include <fcntl.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <system_error>

#include "tests/support/alloc_lock_guard.h"

namespace presa {
namespace {

/// Report of the child to its parent: a system call's number, or one of these.
constexpr int kClean = -1;
constexpr int kThrew = -2;
constexpr int kNoFilter = -3;

int report_pipe = -1;  // of the child; global because a signal handler takes no argument

[[noreturn]] void report(int outcome) {
  const ssize_t written = write(report_pipe, &outcome, sizeof outcome);
  _exit(written == sizeof outcome ? 0 : 1);
}

void onForbiddenCall(int /*signal*/, siginfo_t* info, void* /*context*/) { report(info->si_syscall); }

bool installFilter() {
  struct sigaction action {};
  action.sa_sigaction = onForbiddenCall;
  action.sa_flags = SA_SIGINFO;
  sigaction(SIGSYS, &action, nullptr);

  const auto load = [](std::size_t offset) {
    return sock_filter BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<unsigned>(offset));
  };
  const auto skip_unless = [](long value, unsigned char count) {
    return sock_filter BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<unsigned>(value), 0, count);
  };
  const sock_filter allow = BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
  const sock_filter trap = BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_TRAP);
  std::array filter{
      load(offsetof(seccomp_data, nr)),
      skip_unless(SYS_exit, 1),
      allow,
      skip_unless(SYS_exit_group, 1),
      allow,
      skip_unless(SYS_rt_sigreturn, 1),
      allow,
      skip_unless(SYS_clock_gettime, 1),
      allow,
      skip_unless(SYS_clock_nanosleep, 1),
      allow,
      // write is allowed for the report only
      skip_unless(SYS_write, 3),
      load(offsetof(seccomp_data, args[0])),
      skip_unless(report_pipe, 1),
      allow,
      trap,
  };
  const sock_fprog program{static_cast<unsigned short>(filter.size()), filter.data()};
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

[[noreturn, maybe_unused]] void runChild(const std::function<void()>& function) {
  if (!installFilter()) report(kNoFilter);
  try {
    function();
  } catch (...) {
    report(kThrew);
  }
  report(kClean);
}

/// The outcome as text; "" for a clean run.
[[maybe_unused]] std::string inWords(int outcome) {
  switch (outcome) {
    case kClean:
      return "";
    case kThrew:
      return "an exception";
    case kNoFilter:
      return "the kernel refused the filter";
    case SYS_read:
      return "system call " + std::to_string(outcome) + " (read)";
    case SYS_write:
      return "system call " + std::to_string(outcome) + " (write)";
    case SYS_openat:
      return "system call " + std::to_string(outcome) + " (openat)";
    case SYS_mmap:
      return "system call " + std::to_string(outcome) + " (mmap)";
    case SYS_munmap:
      return "system call " + std::to_string(outcome) + " (munmap)";
    case SYS_brk:
      return "system call " + std::to_string(outcome) + " (brk)";
    case SYS_futex:
      return "system call " + std::to_string(outcome) + " (futex)";
    case SYS_getpid:
      return "system call " + std::to_string(outcome) + " (getpid)";
    default:
      return "system call " + std::to_string(outcome);
  }
}

}  // namespace

std::string runUnderSyscallTrap(const std::function<void()>& function) {
#ifdef PRESA_SANITIZE
  function();
  return "";
#else
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe2");
  const pid_t child = fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (child == 0) {
    report_pipe = ends[1];
    runChild(function);
  }
  close(ends[1]);
  int outcome = kClean;
  const bool told = read(ends[0], &outcome, sizeof outcome) == sizeof outcome;
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (told) return inWords(outcome);
  return WIFSIGNALED(status) ? "signal " + std::to_string(WTERMSIG(status)) : "the child ended without a word";
#endif
}

bool syscallTrapWorks() {
#ifdef PRESA_SANITIZE
  return false;
#else
  static const bool works = runUnderSyscallTrap([] {}).empty();
  return works;
#endif
}

}  // namespace presa
