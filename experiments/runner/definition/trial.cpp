#include "experiments/runner/definition/trial.h"

#include <algorithm>
#include <cmath>

#include "experiments/runner/definition/sample_names.h"

namespace presa::experiment {

Trial::Trial(const Experiment& experiment, std::vector<double> columns, double period)
    : experiment_(experiment),
      period_(period),
      values_(experiment.samples.size(), 0),
      columns_(std::move(columns)),
      stretches_(experiment.phases.size()) {
  values_.insert(values_.end(), columns_.begin(), columns_.end());
  for (const Measure& measure : experiment.measures) {
    aggregates_.emplace_back();
    for (const Aggregate& aggregate : measure.aggregates) aggregates_.back().emplace_back(aggregate);
    if (measure.reaction) reactions_.emplace_back(*measure.reaction, period);
  }
}

void Trial::enter(double time, std::size_t phase) noexcept {
  if (phase > 0) stretches_[phase - 1].end = time;
  phase_ = phase;
  held_since_ = -1;
  stretches_[phase].begin = time;
  const Phase& begun = experiment_.phases[phase];
  if (begun.changes_friction && (!begun.event_when || begun.event_when->holds(values_))) friction_changed_ = true;
}

void Trial::end(double time, State state, Cause cause) noexcept {
  stretches_[phase_].end = time;
  state_ = state;
  cause_ = cause;
}

Trial::State Trial::step(double time) noexcept {
  if (state_ != State::kRunning) return state_;
  if (stretches_[0].begin < 0) enter(time, 0);
  const Phase& phase = experiment_.phases[phase_];
  const double begin = stretches_[phase_].begin;
  values_[SampleReader::kTime] = time;
  // a phase begins with its first tick; clip a rounding error before it
  const double phase_time = std::max(0.0, time - begin);
  values_[SampleReader::kPhaseTime] = phase_time;
  for (auto& measure : aggregates_) {
    for (RunningAggregate& aggregate : measure) aggregate.add(phase_, samples(), begin);
  }
  for (ReactionClock& reaction : reactions_) reaction.add(phase_, samples(), phase_time);
  if (phase.abort && phase.abort->holds(values_)) {
    end(time, State::kAborted, Cause::kGuard);
    return state_;
  }
  if (phase.until && phase.until->holds(values_)) {
    if (held_since_ < 0) held_since_ = time;
  } else {
    held_since_ = -1;
  }
  // half a period of tolerance: times are multiples of the period up to rounding
  const bool met = held_since_ >= 0 && time - held_since_ > phase.hold - 0.5 * period_;
  const bool late = time - begin > phase.seconds - 1.5 * period_;
  if (!met && late && phase.on_timeout == Phase::OnTimeout::kAbort) {
    end(time, State::kAborted, Cause::kTimeout);
  } else if (met || late) {
    if (phase_ + 1 == experiment_.phases.size())
      end(time + period_, State::kDone, Cause::kNone);
    else
      enter(time + period_, phase_ + 1);
  }
  return state_;
}

void Trial::abort(double time, std::string reason) {
  if (state_ != State::kRunning) return;
  outside_reason_ = std::move(reason);
  end(time, State::kAborted, Cause::kOutside);
}

std::string Trial::reason() const {
  const Phase& phase = experiment_.phases[phase_];
  switch (cause_) {
    case Cause::kGuard:
      return phase.abort_reason.empty() ? "aborted in " + phase.name : phase.abort_reason;
    case Cause::kTimeout:
      return "no end of " + phase.name;
    default:
      return outside_reason_;
  }
}

std::vector<double> Trial::results(std::span<const double> quality) const {
  std::vector<double> all = columns_;
  all.insert(all.end(), quality.begin(), quality.end());
  auto reaction = reactions_.begin();
  for (std::size_t m = 0; m < experiment_.measures.size(); ++m) {
    const Measure& measure = experiment_.measures[m];
    if (measure.reaction) {
      all.push_back((reaction++)->onset());
      continue;
    }
    std::vector<double> seen(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(measure.names));
    for (const RunningAggregate& aggregate : aggregates_[m]) seen.push_back(aggregate.result(period_));
    all.push_back(measure.value->evaluate(seen));
  }
  return all;
}

std::string Trial::exclusion(std::span<const double> results) const {
  for (const Exclusion& rule : experiment_.exclusions) {
    if (rule.when->holds(results)) return rule.reason;
    // a trial with a missing value is excluded
    std::vector<bool> asked(results.size(), false);
    rule.when->markSlots(asked);
    for (std::size_t slot = columns_.size(); slot < results.size(); ++slot) {
      if (asked[slot] && std::isnan(results[slot]))
        return rule.reason + ": " + experiment_.names.all()[slot] + " is not there";
    }
  }
  return {};
}

}  // namespace presa::experiment
