#pragma once
#include <sys/types.h>

#include <string>

#include "experiments/faults/probe/probe_log.h"
#include "experiments/faults/temporary_file.h"

namespace presa::faults {

/// A separate program in real time, as a user would start it: one finger on a probe presses a block with 4 N, through
/// the whole chain including the supervisor. The forces at the probe are logged in shared memory, which survives the
/// program.
/// Thread: main, with no other thread in the process, because the program is a fork.
class PressingProgram {
 public:
  /// `scene`, `rig`: attributes of their `<limits …/>`; empty: no element.
  struct Limits {
    std::string scene{}, rig{};
    double stall = 0;    ///< the supervisor is late with its first lower force by that time [s]
    bool presa = false;  ///< run `presa` beside this program instead of a fork of this one; needs no limits
  };
  /// Starts the program and waits until the finger presses: a minute for the first write, because a busy machine starts
  /// programs slowly, and five seconds from it on. Ends at once when the supervisor was held up for kLoss: it holds its
  /// device for lost then, and never presses.
  PressingProgram() : PressingProgram(Limits()) {}
  explicit PressingProgram(const Limits& limits);
  ~PressingProgram();
  PressingProgram(const PressingProgram&) = delete;
  PressingProgram& operator=(const PressingProgram&) = delete;

  pid_t pid() const noexcept { return program_; }
  const ProbeLog& log() const noexcept { return *log_; }
  /// Empty when the finger presses, otherwise the reason.
  const std::string& problem() const noexcept { return problem_; }
  /// Waits at most two seconds for the supervisor to release the device and end; false: it did not.
  bool isReleased() const;

  static constexpr double kForce = 4;     // [N]
  static constexpr double kLoss = 20e-3;  ///< a supervisor that was not scheduled for this long loses its device [s]

 private:
  std::string waitUntilPressed();

  ProbeLog* log_ = nullptr;
  std::string file_;  // path of the log, for the program under test
  TemporaryFile rig_;
  pid_t program_ = -1;
  std::string problem_;
};

/// Longest time between two writes of the supervisor since `begin_ns` [s].
double longestPause(const ProbeLog& log, std::int64_t begin_ns);

}  // namespace presa::faults
