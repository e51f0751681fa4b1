#include "experiments/runner/definition/reaction.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace presa::experiment {
namespace {

constexpr double kNever = std::numeric_limits<double>::quiet_NaN();
constexpr double kLeftBaseline = 2;  // onset line, in standard deviations above the baseline

}  // namespace

ReactionClock::ReactionClock(const Reaction& what, double period)
    : what_(&what),
      window_(static_cast<std::size_t>(std::max(2.0, std::round(what.window / period)))),
      above_since_(kNever),
      onset_(kNever) {}

void ReactionClock::add(std::size_t phase, std::span<const double> samples, double phase_time) noexcept {
  if (phase != what_->baseline && phase != what_->phase) return;
  const double value = what_->value.evaluate(samples);
  if (!std::isfinite(value)) return;  // ignore samples without a finite value
  if (phase == what_->baseline) return remember(value);
  if (!measured_) endBaseline();
  if (!std::isnan(onset_)) return;
  if (!(value > left_)) {
    above_since_ = kNever;
  } else if (std::isnan(above_since_)) {
    above_since_ = phase_time;
  }
  if (value > response_) onset_ = above_since_;
}

void ReactionClock::remember(double value) noexcept { window_[remembered_++ % window_.size()] = value; }

void ReactionClock::endBaseline() noexcept {
  measured_ = true;
  left_ = response_ = std::numeric_limits<double>::infinity();
  const std::size_t count = std::min(remembered_, window_.size());
  if (count < 2) return;
  double mean = 0, squares = 0;
  for (std::size_t i = 0; i < count; ++i) mean += window_[i] / static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i) squares += (window_[i] - mean) * (window_[i] - mean);
  const double sd = std::sqrt(squares / static_cast<double>(count - 1));
  response_ = mean + std::max(what_->threshold, what_->sds * sd);
  left_ = std::min(mean + kLeftBaseline * sd, response_);
}

}  // namespace presa::experiment
