#include "experiments/runner/definition/queue.h"

#include <algorithm>
#include <utility>

#include "framework/core/math/random.h"

namespace presa::experiment {

TrialQueue::TrialQueue(std::vector<PlannedTrial> planned, const Retry& retry)
    : waiting_(planned.begin(), planned.end()), retry_(retry) {}

void TrialQueue::finish(Outcome outcome, const std::optional<psychophysics::Response>&) {
  if (outcome == Outcome::kInterrupted) return;  // the trial stays at the front
  PlannedTrial trial = waiting_.front();
  waiting_.pop_front();
  if (outcome == Outcome::kDone) {
    ++done_;
    return;
  }
  if (outcome == Outcome::kSkipped || trial.attempt >= retry_.attempts) {
    ++missing_;
    return;
  }
  ++trial.attempt;
  trial.seed = RandomStream(trial.seed, "another attempt").bits();
  auto place = waiting_.begin();
  if (retry_.place == Retry::Place::kEndOfBlock) {
    place = std::find_if(waiting_.begin(), waiting_.end(),
                         [&](const PlannedTrial& other) { return other.block != trial.block; });
  }
  waiting_.insert(place, std::move(trial));
}

}  // namespace presa::experiment
