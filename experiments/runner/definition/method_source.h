#pragma once
#include <deque>

#include "experiments/runner/definition/trial_source.h"

namespace presa::experiment {

/// Trials that a method chooses, block by block: each planned condition is a block with a method of its own. Practice
/// presents the method's first stimulus and forgets the answer.
class MethodSource final : public TrialSource {
 public:
  /// `planned`: see planTrials; outlived by `experiment`.
  MethodSource(const Experiment& experiment, std::vector<PlannedTrial> planned);

  const PlannedTrial* next() const override { return next_ ? &*next_ : nullptr; }
  void finish(Outcome outcome, const std::optional<psychophysics::Response>& response) override;
  std::size_t done() const override { return done_; }
  std::size_t missing() const override { return 0; }
  std::size_t left() const override;
  const psychophysics::Method* method() const override { return method_.get(); }

 private:
  /// The next trial of the method; the next block when it has finished.
  void advance();

  const Experiment& experiment_;
  std::deque<PlannedTrial> blocks_;  // the first one goes on
  std::unique_ptr<psychophysics::Method> method_;
  std::optional<PlannedTrial> next_;
  std::size_t done_ = 0;
  int number_ = 1, attempt_ = 1;  // of the next trial; attempts since the last answer
};

}  // namespace presa::experiment
