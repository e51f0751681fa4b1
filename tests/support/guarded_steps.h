#pragma once
#include <array>
#include <cstdint>
#include <string>

#include "framework/core/schedule/executor.h"
#include "framework/session/session.h"

namespace presa::test {

/// Steps a session by hand, in the order of the lockstep executor, with the trap of RealTimeGuard around every step.
class GuardedSteps {
 public:
  explicit GuardedSteps(Session& session);
  ~GuardedSteps();
  GuardedSteps(const GuardedSteps&) = delete;
  GuardedSteps& operator=(const GuardedSteps&) = delete;

  void run(std::uint64_t haptic_ticks);
  /// What the steps of a group did that a real-time thread must not: "malloc at 0.005", or empty.
  const std::string& violation(RateGroup group) const { return first_[static_cast<std::size_t>(group)]; }

 private:
  Session& session_;
  RateTable rates_;
  std::uint64_t next_ = 0;
  std::array<std::string, kRateGroupCount> first_;
};

}  // namespace presa::test
