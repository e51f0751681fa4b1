#pragma once
#include <algorithm>
#include <cmath>

#include "framework/core/math/spatial.h"

namespace presa::pointer {

/// A value that follows a target smoothly: its rate and its acceleration are bounded, however the target jumps. Thread:
/// haptic.
template <class Value>
class Follower {
 public:
  /// `rate`: max rate [1/s]; `time`: time constant of the approach [s]. The acceleration is at most rate / time, which
  /// avoids overshoot.
  Follower(const Value& start, double rate, double time) : value_(start), max_rate_(rate), time_(time) {}

  void step(const Value& wanted, double period) noexcept {
    const Value rate = bounded((wanted - value_) / time_, max_rate_);
    rate_ = rate_ + bounded(rate - rate_, max_rate_ / time_ * period);
    value_ = value_ + rate_ * period;
  }
  const Value& value() const noexcept { return value_; }
  const Value& rate() const noexcept { return rate_; }

 private:
  static double bounded(double v, double max) noexcept { return std::clamp(v, -max, max); }
  static Vec3 bounded(const Vec3& v, double max) noexcept {
    const double norm = v.norm();
    return norm > max ? Vec3(v * (max / norm)) : v;
  }
  static double zero(double) noexcept { return 0; }
  static Vec3 zero(const Vec3&) noexcept { return Vec3::Zero(); }

  Value value_;
  Value rate_ = zero(Value());
  double max_rate_, time_;
};

}  // namespace presa::pointer
