#pragma once
#include <algorithm>
#include <cmath>

namespace presa {

/// Thermal model of one finger's motors: heat is the temperature rise as a share of the rise that the continuous rating
/// allows, first order in the square of the force: heat' = ((F / continuous)^2 - heat) / heating_time. The step is
/// exact for a force held over the period. Thread: haptic; nonblocking.
class ThermalBudget {
 public:
  /// `continuous` [N], infinite: never warm; `heating_time`: time constant [s].
  ThermalBudget(double continuous, double heating_time) : continuous_(continuous), heating_time_(heating_time) {}

  /// `force`: magnitude held over `period` [N], [s].
  void step(double force, double period) noexcept {
    const double load = force / continuous_;
    heat_ += -std::expm1(-period / heating_time_) * (load * load - heat_);
  }
  double heat() const noexcept { return heat_; }  ///< 1: that of `continuous` for unlimited time
  /// The largest force allowed now [N]: `peak` up to a heat of 0.9, then falling, `continuous` at a heat of 1.
  double maxForce(double peak) const noexcept {
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
