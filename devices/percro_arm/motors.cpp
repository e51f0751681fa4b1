#include "devices/percro_arm/motors.h"

#include <algorithm>
#include <cmath>

namespace presa::percro {
namespace {

constexpr double kFold = 0.1;  // range of heat over which the limit falls from peak to continuous torque

}  // namespace

Vec3 MotorDrive::limits() const noexcept {
  const double low = motors_.continuous_torque * motors_.continuous_torque;
  const double high = motors_.peak_torque * motors_.peak_torque;
  Vec3 limits;
  for (int i = 0; i < 3; ++i) limits[i] = std::sqrt(low + (high - low) * std::clamp((1 - heat_[i]) / kFold, 0.0, 1.0));
  return limits;
}

double MotorDrive::command(const Vec3& carried, const Vec3& wanted) noexcept {
  const Vec3 max = limits();
  double share = 1;
  for (int i = 0; i < 3; ++i) {
    const double room = wanted[i] > 0 ? max[i] - carried[i] : max[i] + carried[i];
    if (std::abs(wanted[i]) > room) share = std::min(share, std::max(0.0, room) / std::abs(wanted[i]));
  }
  command_ = (carried + share * wanted).cwiseMax(-max).cwiseMin(max);
  return share;
}

Vec3 MotorDrive::step(double h) noexcept {
  const double turns = 2 * std::numbers::pi * motors_.current_bandwidth * h;
  const double keep = std::exp(-turns), mean_of_rest = (1 - keep) / turns;
  Vec3 mean = command_ + mean_of_rest * (torque_ - command_);
  torque_ = command_ + keep * (torque_ - command_);
  const double warm = 1 - std::exp(-h / motors_.thermal_time);
  heat_ += warm * ((mean / motors_.continuous_torque).cwiseAbs2() - heat_);
  return mean;
}

}  // namespace presa::percro
