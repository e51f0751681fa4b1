#pragma once
#include <deque>

#include "experiments/runner/definition/trial_source.h"

namespace presa::experiment {

/// Trials chosen by a psychophysical method. Each planned condition is a block with its own instance of the method. A
/// practice trial presents the first stimulus of a fresh method and discards the answer.
class MethodSource final : public TrialSource {
 public:
  /// `planned`: the blocks, as planTrials() returns them. `experiment` must outlive this object.
  MethodSource(const Experiment& experiment, std::vector<PlannedTrial> planned);

  const PlannedTrial* next() const override { return next_ ? &*next_ : nullptr; }
  void finish(Outcome outcome, const std::optional<psychophysics::Response>& response) override;
  std::size_t done() const override { return done_; }
  std::size_t missing() const override { return 0; }
  std::size_t left() const override;
  const psychophysics::Method* method() const override { return method_.get(); }

 private:
  /// Offers the next trial of the current method, or starts the next block when the method has finished.
  void advance();

  const Experiment& experiment_;
  std::deque<PlannedTrial> blocks_;  // front: the current block
  std::unique_ptr<psychophysics::Method> method_;
  std::optional<PlannedTrial> next_;
  std::size_t done_ = 0;
  int number_ = 1, attempt_ = 1;  // of the next trial; attempts since the last answer
};

}  // namespace presa::experiment
