#include "devices/percro_arm/simulated_arm.h"

#include <cmath>

namespace presa::percro {

SimulatedArm::SimulatedArm(const Parameters& parameters, const Vec3& gravity, double period)
    : parameters_(parameters),
      dynamics_(parameters, gravity),
      drive_(parameters.motors),
      encoders_(parameters),
      to_joint_torque_(transmission(parameters.geometry).transpose()),
      to_motor_torque_(transmissionInverse(parameters.geometry).transpose()),
      period_(period),
      substeps_(std::max(1, static_cast<int>(std::ceil(period / kSubstep - 1e-9)))) {
  place({0.5 * (parameters.geometry.length_min + parameters.geometry.length_max), 0, 0});
}

void SimulatedArm::place(const Vec3& p_DT) noexcept {
  state_ = dynamics_.atRest(p_DT);
  encoders_.reset(state_.q);
}

void SimulatedArm::command(const Vec3& f_D) noexcept {
  const Joints q = encoders_.joints();
  const Vec3 carried = to_motor_torque_ * dynamics_.weight(q);
  const Vec3 wanted = to_motor_torque_ * (jacobian(parameters_.geometry, q).transpose() * f_D);
  min_share_ = std::min(min_share_, drive_.command(carried, wanted));
}

void SimulatedArm::advance(const TipLoad& load) noexcept {
  const double h = period_ / substeps_;
  for (int i = 0; i < substeps_; ++i) dynamics_.step(state_, to_joint_torque_ * drive_.step(h), load, h);
  max_heat_ = std::max(max_heat_, drive_.heat().maxCoeff());
  encoders_.sample(state_.q);
}

Vec3 SimulatedArm::reportedPosition() const noexcept { return tipPosition(parameters_.geometry, encoders_.joints()); }

Vec3 SimulatedArm::reportedVelocity() const noexcept {
  return jacobian(parameters_.geometry, encoders_.joints()) * encoders_.jointRates(period_);
}

}  // namespace presa::percro
