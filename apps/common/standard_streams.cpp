#include "apps/common/standard_streams.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

namespace presa {

void openStandardStreams() {
  // open() takes the lowest free number, so that each gets its own; output is opened read-only, so that writing to it
  // fails
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(descriptor, F_GETFD) >= 0 || errno != EBADF) continue;
    if (::open("/dev/null", descriptor == STDERR_FILENO ? O_RDWR : O_RDONLY) != descriptor) ::_exit(1);
  }
  std::signal(SIGXFSZ, SIG_IGN);
}

bool outputLost() {
  const bool failed_before = std::ferror(stdout) != 0;
  if (failed_before) {  // the reason is no longer known: it is that of one more byte
    std::clearerr(stdout);
    std::fputc('\n', stdout);
  }
  errno = 0;
  if (std::fflush(stdout) == 0 && !failed_before) return false;
  std::fprintf(stderr, "presa: error: standard output could not be written: %s\n",
               errno != 0 ? std::strerror(errno) : "part of it is lost");
  return true;
}

}  // namespace presa
