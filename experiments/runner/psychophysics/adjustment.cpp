#include "experiments/runner/psychophysics/adjustment.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace presa::psychophysics {

std::vector<std::string> mistakes(const AdjustmentPlan& plan) {
  std::vector<std::string> found;
  const auto require = [&](bool holds, const char* text) {
    if (!holds) found.emplace_back(text);
  };
  require(plan.trials > 0, "the number of trials must be > 0");
  require(plan.nearest >= 0 && plan.farthest > 0 && plan.nearest <= plan.farthest && std::isfinite(plan.farthest),
          "starts must lie at 0 <= nearest <= farthest from the centre, farthest > 0");
  require(plan.centre - plan.farthest >= plan.min && plan.centre + plan.farthest <= plan.max,
          "every start must lie between the min and the max level");
  require(plan.fine > 0 && plan.coarse >= plan.fine, "steps must be coarse >= fine > 0");
  require(plan.confirmations > 0, "the number of confirmations must be > 0");
  return found;
}

Adjustment::Adjustment(AdjustmentPlan plan, const RandomStream& stream) : plan_(plan), stream_(stream) {
  requireNone(mistakes(plan_));
  const std::size_t above = (plan_.trials + (stream_.uniform() < 0.5 ? 1 : 0)) / 2;
  for (std::size_t i = 0; i < plan_.trials; ++i) {
    const double distance = stream_.uniform(plan_.nearest, plan_.farthest);
    starts_.push_back(plan_.centre + (i < above ? distance : -distance));
  }
  stream_.shuffle(std::span<double>(starts_));
  start();
}

Settings Adjustment::settings() const {
  double sum = 0, squares = 0;
  double sum_from[2] = {0, 0}, n_from[2] = {0, 0};
  Settings settings;
  for (const Trial& trial : trials()) {
    if (!trial.response) continue;
    const double value = trial.response->value;
    ++settings.n, ++n_from[trial.stimulus.track];
    sum += value, sum_from[trial.stimulus.track] += value;
  }
  if (settings.n == 0) return settings;
  settings.mean = sum / static_cast<double>(settings.n);
  for (const Trial& trial : trials()) {
    if (trial.response) squares += std::pow(trial.response->value - settings.mean, 2);
  }
  if (settings.n > 1) settings.sd = std::sqrt(squares / static_cast<double>(settings.n - 1));
  settings.mean_from_below = sum_from[0] / n_from[0];  // 0 / 0 gives the documented NaN
  settings.mean_from_above = sum_from[1] / n_from[1];
  return settings;
}

void Adjustment::update(Trial& trial) {
  const double value = trial.response->value;
  if (!std::isfinite(value) || value < plan_.min || value > plan_.max) {
    throw std::invalid_argument("a setting must lie between the min and the max level");
  }
  ++answered_;
}

std::optional<Stimulus> Adjustment::choose() {
  if (answered_ == starts_.size()) return std::nullopt;
  const double level = starts_[answered_];
  return Stimulus{.level = level, .track = level > plan_.centre ? 1U : 0U, .kind = TrialKind::kAdjustment};
}

Stimulus Adjustment::again(const Stimulus& /*discarded*/) {
  std::swap(starts_[answered_], starts_[answered_ + stream_.below(starts_.size() - answered_)]);
  return choose().value();
}

Adjuster::Adjuster(const AdjustmentPlan& plan, double start) : plan_(plan), level_(start) {}

void Adjuster::press(AdjustmentKey key) {
  if (done()) return;
  if (key == AdjustmentKey::kConfirm) {
    ++confirmed_;
    return;
  }
  confirmed_ = 0;
  const bool up = key == AdjustmentKey::kUp || key == AdjustmentKey::kUpFine;
  const double step = key == AdjustmentKey::kUp || key == AdjustmentKey::kDown ? plan_.coarse : plan_.fine;
  level_ = std::clamp(level_ + (up ? step : -step), plan_.min, plan_.max);
}

}  // namespace presa::psychophysics
