#include "framework/device/output_stage.h"

#include <algorithm>
#include <cmath>

namespace presa {

Vec3 OutputStage::step(const Input& input, double period) noexcept {
  status_ = kOutputClean;

  const Vec3& wanted = input.command;
  if (std::isfinite(wanted.x()) && std::isfinite(wanted.y()) && std::isfinite(wanted.z())) {
    if (!latched_) good_ = wanted;
  } else {
    latched_ = true;
  }
  if (latched_) status_ |= kOutputNotFinite;
  Vec3 force = good_;  // after a fault: fade from the last command that made sense

  // scaled by the largest component first: the square of 1e308 would overflow
  if (const double largest = force.cwiseAbs().maxCoeff(); largest > limits_.force) {
    force *= limits_.force / largest;
    status_ |= kOutputMagnitude;
  }
  if (const double norm = force.norm(); norm > limits_.force) {
    force *= limits_.force / norm;
    status_ |= kOutputMagnitude;
  }

  if (input.information_old) status_ |= kOutputWatchdog;
  const bool falling = latched_ || input.stop || input.information_old;
  gain_ =
      falling ? std::max(0.0, gain_ - period / limits_.fade_out) : std::min(1.0, gain_ + period / limits_.soft_start);
  if (gain_ < 1) status_ |= kOutputFading;
  force *= gain_;

  // last, so that nothing above can make a step
  const double step = input.held ? 0 : limits_.force_rate * period;
  if (const Vec3 change = force - last_; change.norm() > step) {
    force = last_ + change * (step / change.norm());
    status_ |= kOutputSlew;
  }
  last_ = force;
  return force;
}

}  // namespace presa
