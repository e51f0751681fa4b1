#pragma once
#include <deque>
#include <vector>

#include "framework/experiment/order.h"

namespace presa::experiment {

/// How one run of a trial ended.
enum class Outcome {
  kDone,
  kAborted,      ///< by a rule of the file: tried again as often as that allows
  kInterrupted,  ///< by a crash, a lost device or the operator's stop: run again at once, with the same seed
  kSkipped       ///< the operator leaves it out
};

/// The trials that are still to come. A pure function of the plan and of the outcomes so far: replaying the outcomes of a log
/// rebuilds it exactly.
class TrialQueue {
 public:
  TrialQueue(std::vector<PlannedTrial> planned, const Retry& retry);

  /// Null at the end.
  const PlannedTrial* next() const noexcept { return waiting_.empty() ? nullptr : &waiting_.front(); }
  /// What became of next(); there is one.
  void finish(Outcome outcome);

  std::size_t planned() const noexcept { return planned_; }
  std::size_t done() const noexcept { return done_; }
  /// Trials given up after their last attempt, or skipped.
  std::size_t missing() const noexcept { return missing_; }
  const std::deque<PlannedTrial>& waiting() const noexcept { return waiting_; }

 private:
  std::deque<PlannedTrial> waiting_;
  Retry retry_;
  std::size_t planned_, done_ = 0, missing_ = 0;
};

}  // namespace presa::experiment
