#include "experiments/runner/psychophysics/interleaved.h"

namespace presa::psychophysics {

std::vector<StaircaseRule> onBothSides(StaircaseRule rule, std::size_t copies) {
  std::vector<StaircaseRule> rules;
  for (const int side : {1, -1}) {
    rule.side = side;
    rules.insert(rules.end(), copies, rule);
  }
  return rules;
}

std::vector<std::string> mistakes(const InterleavedPlan& plan) {
  std::vector<std::string> found;
  if (plan.tracks.empty()) found.emplace_back("there must be at least one staircase");
  if (!(plan.catch_rate >= 0 && plan.catch_rate < 1)) found.emplace_back("the catch rate must be in [0, 1)");
  for (std::size_t i = 0; i < plan.tracks.size(); ++i) {
    for (const std::string& mistake : mistakes(plan.tracks[i])) {
      found.push_back("staircase " + std::to_string(i + 1) + ": " + mistake);
    }
  }
  return found;
}

Interleaved::Interleaved(const InterleavedPlan& plan, const RandomStream& stream)
    : catch_rate_(plan.catch_rate), catch_level_(plan.catch_level), stream_(stream) {
  requireNone(mistakes(plan));
  for (const StaircaseRule& rule : plan.tracks) tracks_.emplace_back(rule);
  start();
}

std::optional<double> Interleaved::threshold(std::size_t last) const {
  double sum = 0;
  for (const Staircase& track : tracks_) {
    const std::optional<double> threshold = track.threshold(last);
    if (!threshold) return std::nullopt;
    sum += *threshold;
  }
  return sum / static_cast<double>(tracks_.size());
}

void Interleaved::update(Trial& trial) {
  if (trial.stimulus.kind == TrialKind::kTest) tracks_[trial.stimulus.track].respond(*trial.response);
}

std::optional<Stimulus> Interleaved::choose() {
  std::vector<std::size_t> running;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (!tracks_[i].finished()) running.push_back(i);
  }
  if (running.empty()) return std::nullopt;
  if (stream_.uniform() < catch_rate_) {
    return Stimulus{.level = catch_level_, .track = tracks_.size(), .kind = TrialKind::kCatch};
  }
  const std::size_t track = running[stream_.below(running.size())];
  return Stimulus{.level = tracks_[track].next()->level, .track = track};
}

}  // namespace presa::psychophysics
