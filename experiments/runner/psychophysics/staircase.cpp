#include "experiments/runner/psychophysics/staircase.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace presa::psychophysics {

double StaircaseRule::targetProportion() const {
  return std::pow(1 / (1 + down_up_ratio), 1.0 / static_cast<double>(down));
}

StaircaseRule weightedUpDown(double target) { return {.down = 1, .down_up_ratio = (1 - target) / target}; }

std::vector<std::string> mistakes(const StaircaseRule& rule) {
  std::vector<std::string> found;
  const auto require = [&](bool holds, const char* text) {
    if (!holds) found.emplace_back(text);
  };
  const auto is_step = [](double step) { return step > 0 && std::isfinite(step); };
  require(!rule.steps_up.empty() && std::ranges::all_of(rule.steps_up, is_step), "steps up must be given and be > 0");
  require(is_step(rule.down_up_ratio), "the ratio of steps down to steps up must be > 0");
  require(rule.down > 0, "the number of positive answers before a step down must be > 0");
  require(rule.change_after > 0, "the number of reversals before the step changes must be > 0");
  require(std::isfinite(rule.start) && rule.min <= rule.start && rule.start <= rule.max,
          "the start must lie between the min and the max level");
  require(rule.stop_trials > 0, "the max number of trials must be > 0");
  require(rule.side == 1 || rule.side == -1, "the side must be 1 or -1");
  return found;
}

Staircase::Staircase(StaircaseRule rule) : rule_(std::move(rule)), distance_(rule_.start) {
  requireNone(mistakes(rule_));
  start();
}

std::optional<double> Staircase::threshold(std::size_t last) const {
  if (last == 0 || reversals_.size() < last) return std::nullopt;
  const auto from = reversals_.end() - static_cast<std::ptrdiff_t>(last);
  return std::accumulate(from, reversals_.end(), 0.0) / static_cast<double>(last);
}

void Staircase::update(Trial& trial) {
  ++answers_;
  if (!trial.response->positive) {
    run_ = 0;
    move(1);
    return;
  }
  const bool first = rule_.one_down_first && reversals_.empty();
  if (++run_ < (first ? 1 : rule_.down)) return;
  run_ = 0;
  move(-1);
}

void Staircase::move(int direction) {
  const double up = rule_.steps_up[std::min(reversals_.size() / rule_.change_after, rule_.steps_up.size() - 1)];
  if (direction_ == -direction) reversals_.push_back(distance_);
  direction_ = direction;
  distance_ = std::clamp(distance_ + (direction > 0 ? up : -up * rule_.down_up_ratio), rule_.min, rule_.max);
}

std::optional<Stimulus> Staircase::choose() {
  const bool turned_enough = rule_.stop_reversals > 0 && reversals_.size() >= rule_.stop_reversals;
  if (turned_enough || answers_ >= rule_.stop_trials) return std::nullopt;
  return Stimulus{.level = rule_.side * distance_};
}

}  // namespace presa::psychophysics
