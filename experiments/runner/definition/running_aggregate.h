#pragma once
#include <cmath>
#include <limits>

#include "experiments/runner/definition/expression.h"

namespace presa::experiment {

/// Computes an aggregate online, without storing samples. Mean and standard deviation after Welford (1962), which is
/// accurate for a large mean. Thread: haptic; nonblocking.
class RunningAggregate {
 public:
  explicit RunningAggregate(const Aggregate& what) : what_(&what) {}

  void add(std::size_t phase, std::span<const double> samples, double phase_begin) noexcept {
    if (phase != what_->phase) return;
    begin_ = phase_begin;
    if (what_->condition && !what_->condition->holds(samples)) return;
    if (!what_->value) {
      ++count_;
      return;
    }
    const double x = what_->value->evaluate(samples);
    if (!(std::abs(x) <= std::numeric_limits<double>::max())) return;  // ignore values that are not finite
    ++count_;
    if (count_ == 1) first_ = min_ = max_ = x;
    last_ = x;
    min_ = std::fmin(min_, x);
    max_ = std::fmax(max_, x);
    const double change = x - mean_;
    mean_ += change / static_cast<double>(count_);
    squares_ += change * (x - mean_);
  }

  /// NaN without samples. `period`: the sample period [s].
  double result(double period) const noexcept {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    using Kind = Aggregate::Kind;
    if (what_->kind == Kind::kSeconds) return static_cast<double>(count_) * period;
    if (what_->kind == Kind::kStart) return begin_;
    if (count_ == 0) return kNaN;
    switch (what_->kind) {
      case Kind::kMean:
        return mean_;
      case Kind::kSd:
        return count_ > 1 ? std::sqrt(squares_ / static_cast<double>(count_ - 1)) : kNaN;
      case Kind::kMin:
        return min_;
      case Kind::kMax:
        return max_;
      case Kind::kFirst:
        return first_;
      default:
        return last_;
    }
  }

 private:
  const Aggregate* what_;
  std::size_t count_ = 0;
  double begin_ = std::numeric_limits<double>::quiet_NaN();
  double first_ = 0, last_ = 0, min_ = 0, max_ = 0, mean_ = 0, squares_ = 0;
};

}  // namespace presa::experiment
