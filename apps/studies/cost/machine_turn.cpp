#include "apps/studies/cost/machine_turn.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <utility>

namespace presa::cost {

MachineTurn::MachineTurn(MachineTurn&& other) noexcept : file_(std::exchange(other.file_, -1)) {}

// Runs are forks that share the open file: closing it here would leave the lock to them.
MachineTurn::~MachineTurn() {
  if (file_ < 0) return;
  flock(file_, LOCK_UN);
  close(file_);
}

bool MachineTurn::take(Kind kind) {
  if (file_ < 0) {
    // the same for all jobs of a machine, whatever their TMPDIR
    const std::string lock = "/tmp/presa-cost-" + std::to_string(getuid()) + ".lock";
    file_ = open(lock.c_str(), O_CREAT | O_RDWR | O_CLOEXEC | O_NOFOLLOW, 0600);
    if (file_ < 0) return true;
  }
  return flock(file_, (kind == kAlone ? LOCK_EX : LOCK_SH) | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

}  // namespace presa::cost
