#pragma once
#include <deque>
#include <vector>

#include "experiments/runner/definition/trial_source.h"

namespace presa::experiment {

/// The planned trials that are still to be run, for an experiment without a method.
class TrialQueue final : public TrialSource {
 public:
  TrialQueue(std::vector<PlannedTrial> planned, const Retry& retry);

  const PlannedTrial* next() const override { return waiting_.empty() ? nullptr : &waiting_.front(); }
  void finish(Outcome outcome, const std::optional<psychophysics::Response>& response = std::nullopt) override;
  std::size_t done() const override { return done_; }
  std::size_t missing() const override { return missing_; }
  std::size_t left() const override { return waiting_.size(); }
  const std::deque<PlannedTrial>& waiting() const noexcept { return waiting_; }

 private:
  std::deque<PlannedTrial> waiting_;
  Retry retry_;
  std::size_t done_ = 0, missing_ = 0;
};

}  // namespace presa::experiment
