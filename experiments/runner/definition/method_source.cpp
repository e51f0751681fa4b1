#include "experiments/runner/definition/method_source.h"

#include "experiments/runner/definition/queue.h"
#include "framework/core/math/random.h"

namespace presa::experiment {

MethodSource::MethodSource(const Experiment& experiment, std::vector<PlannedTrial> planned)
    : experiment_(experiment), blocks_(planned.begin(), planned.end()) {
  advance();
}

void MethodSource::advance() {
  while (method_ && method_->finished()) {
    method_.reset();
    blocks_.pop_front();
  }
  next_.reset();
  if (blocks_.empty()) return;
  const PlannedTrial& block = blocks_.front();
  if (!method_) method_ = makeMethod(*experiment_.procedure, block.seed);
  next_ = block;
  next_->number = block.practice ? block.number : number_;
  next_->attempt = attempt_;
  next_->stimulus = method_->next();
  // seeded by number and attempt, so that an interrupted trial is repeated with the same seed
  next_->seed = RandomStream(block.seed, "trial", std::uint64_t(next_->number) * 1000 + std::uint64_t(attempt_)).bits();
}

void MethodSource::finish(Outcome outcome, const std::optional<psychophysics::Response>& response) {
  if (outcome == Outcome::kInterrupted) return;
  if (outcome != Outcome::kDone || !response) {
    ++attempt_;
    method_->discard();
    return advance();
  }
  ++done_;
  attempt_ = 1;
  if (next_->practice) {
    method_.reset();
    blocks_.pop_front();
  } else {
    ++number_;
    method_->respond(*response);
  }
  advance();
}

std::size_t MethodSource::left() const {
  if (!next_) return 0;
  std::size_t left = 0;
  for (const PlannedTrial& block : blocks_) left += block.practice ? 1 : maxTrials(*experiment_.procedure);
  if (next_->practice) return left;
  std::size_t answered = 0;
  for (const psychophysics::Trial& trial : method_->trials()) answered += trial.response ? 1 : 0;
  return left > answered ? left - answered : 1;
}

std::unique_ptr<TrialSource> makeTrialSource(const Experiment& experiment, int subject_number, int session) {
  std::vector<PlannedTrial> planned = planTrials(experiment, subject_number, session);
  if (experiment.procedure) return std::make_unique<MethodSource>(experiment, std::move(planned));
  return std::make_unique<TrialQueue>(std::move(planned), experiment.retry);
}

}  // namespace presa::experiment
