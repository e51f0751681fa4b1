#pragma once
#include <algorithm>
#include <cmath>

namespace presa {

/// How warm the force of one finger has made its motors, as a share of the rise that the continuous rating allows: first order in
/// the square of the force, heat' = ((F / continuous)^2 - heat) / heating_time. Thread: haptic; nonblocking.
class ThermalBudget {
 public:
  /// [N], [s]; infinite: never warm.
  ThermalBudget(double continuous, double heating_time) : continuous_(continuous), heating_time_(heating_time) {}

  /// `force`: that was held over the period [N].
  void step(double force, double period) noexcept {
    const double load = force / continuous_;
    heat_ += -std::expm1(-period / heating_time_) * (load * load - heat_);
  }
  double heat() const noexcept { return heat_; }
  /// The force that may be given now: any while cool, in the last tenth less and less, hot the continuous one.
  double most(double peak) const noexcept {
    if (!(peak > continuous_)) return peak;
    const double room = std::clamp((1 - heat_) / kFold, 0.0, 1.0);
    return std::sqrt(continuous_ * continuous_ + room * (peak * peak - continuous_ * continuous_));
  }

 private:
  static constexpr double kFold = 0.1;
  double continuous_, heating_time_;
  double heat_ = 0;
};

}  // namespace presa
