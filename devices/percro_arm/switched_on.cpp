#include "devices/percro_arm/switched_on.h"

#include <algorithm>
#include <cmath>

namespace presa::percro {
namespace {

constexpr double kModelPeriod = 1e-3, kPatience = 90;  // [s]

}  // namespace

SwitchedOn::SwitchedOn(const Parameters& parameters, const Vec3& gravity, const Markers& markers, RandomStream& stream)
    : parameters_(parameters),
      markers_(markers),
      arm_(parameters, gravity, kModelPeriod),
      homing_(parameters, markers, kModelPeriod) {
  for (int i = 0; i < 3; ++i) zero_[i] = std::nearbyint(stream.uniform(-2e4, 2e4));
  arm_.encoders().powerUp(zero_);
  const double tilt = stream.uniform(-0.4, 0.4), yaw = stream.uniform(-0.4, 0.4);
  arm_.place(tipPosition(parameters.geometry, {tilt, yaw, stream.uniform(0.05, 0.55)}));
}

void SwitchedOn::look() {
  for (std::size_t i = 0; i < 3; ++i) {
    const auto joint = static_cast<Eigen::Index>(i);
    const double above = arm_.state().q[joint] - markers_.at[joint];
    covered_[i] = above >= 0 || (covered_[i] && above > -markers_.hysteresis);
  }
}

void SwitchedOn::step(const TipLoad& load) {
  look();
  arm_.commandJoints(homing_.step(arm_.encoders().joints(), arm_.encoders().jointRates(kModelPeriod), covered_));
  arm_.advance(load);
  fastest_ = std::max(fastest_, arm_.state().v.norm());
}

const Homing& SwitchedOn::home(const TipLoad& load) {
  for (int i = 0; i < kPatience / kModelPeriod && !homing_.done() && homing_.failure() == Homing::Failure::kNone; ++i)
    step(load);
  if (homing_.done())
    arm_.encoders().setZero(transmission(parameters_.geometry) * homing_.offset() / parameters_.motors.count());
  return homing_;
}

Vec3 SwitchedOn::zeroError() const {
  return transmission(parameters_.geometry) * homing_.offset() / parameters_.motors.count() - zero_;
}

}  // namespace presa::percro
