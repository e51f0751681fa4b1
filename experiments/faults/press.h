#pragma once
#include <sys/types.h>

#include <string>

#include "experiments/faults/probe/probe_log.h"

namespace presa::faults {

/// A program of its own, as a user would start it, in real time: one finger on a probe leans on a block with 4 N, through the whole
/// chain, supervisor and all. What reaches the probe is seen from here, whatever becomes of the program.
/// Thread: main, with no other thread in the process: the program is a fork.
class PressingProgram {
 public:
  /// What its files say of limits, each between `<limits ` and `/>`; empty: nothing.
  struct Limits {
    std::string scene, rig;
  };
  /// Starts it and waits until the finger is pressed, or five seconds.
  explicit PressingProgram(const Limits& limits = {});
  ~PressingProgram();
  PressingProgram(const PressingProgram&) = delete;
  PressingProgram& operator=(const PressingProgram&) = delete;

  pid_t pid() const noexcept { return program_; }
  const ProbeLog& log() const noexcept { return *log_; }
  /// Empty when the finger is pressed, otherwise what is seen instead.
  const std::string& problem() const noexcept { return problem_; }
  /// The supervisor has let go of the device and ended, within two seconds.
  bool isReleased() const;

  static constexpr double kForce = 4;  // [N]

 private:
  std::string waitUntilPressed();

  ProbeLog* log_ = nullptr;
  std::string file_;  // of the log, for whoever opens it
  pid_t program_ = -1;
  std::string problem_;
};

}  // namespace presa::faults
