#include "framework/device/output_stage.h"

#include <algorithm>
#include <cmath>

namespace presa {
namespace {

// Whether a position [m] or a velocity [m/s] is finite and below 1000 in every component.
bool plausible(const Vec3& v) { return v.allFinite() && v.cwiseAbs().maxCoeff() < 1e3; }

}  // namespace

OutputStage::OutputStage(const OutputLimits& limits)
    : limits_(limits),
      force_{limits.force,
             limits.force_rate,
             limits.continuous,
             {limits.continuous, limits.heating_time},
             PassivityController()},
      torque_{limits.torque,
              limits.torque_rate,
              limits.continuous_torque,
              {limits.continuous_torque, limits.heating_time},
              PassivityController(PassivityController::kMaxTurnDamping)} {}

const Wrench& OutputStage::step(const Input& input, double period) noexcept {
  status_ = kOutputClean;
  latchFaults(input);
  const Vec3 force = bounded(force_, good_.f, last_.f, {input.p_WH, input.v_WH}, period);
  const double gain = fade(input, period);
  last_.f = slewLimit(force * gain, last_.f, input.catch_up ? 0 : force_.rate * period);
  if (limits_.passivity) force_.energy.sent(last_.f);
  if (torque_.max > 0) stepTorque(input, gain, period);
  return last_;
}

void OutputStage::stepTorque(const Input& input, double gain, double period) noexcept {
  if (limits_.passivity && input.q_WT.coeffs().allFinite()) {
    const Eigen::AngleAxisd turn(input.q_WT * q_WT_.conjugate());
    turned_ += turn.angle() * turn.axis();
    q_WT_ = input.q_WT;
  }
  const Vec3 torque = bounded(torque_, good_.t, last_.t, {turned_, input.w_WT}, period);
  last_.t = slewLimit(torque * gain, last_.t, input.catch_up ? 0 : torque_.rate * period);
  if (limits_.passivity) torque_.energy.sent(last_.t);
}

Vec3 OutputStage::bounded(Part& part, const Vec3& wanted, const Vec3& last, const Motion& motion,
                          double period) noexcept {
  part.budget.step(last.norm(), period);
  Vec3 force = clampMagnitude(wanted, part.max, kOutputMagnitude);
  if (limits_.passivity && plausible(motion.x) && plausible(motion.v)) {
    force = part.energy.step(force, motion.x, motion.v, period);
    if (part.energy.acting()) status_ |= kOutputDamped;
    force = clampMagnitude(force, part.max, kOutputMagnitude);
  }
  return thermalLimit(part, force, last);
}

void OutputStage::rearm() noexcept {
  latches_ = 0;
  good_ = {};
  gain_ = 0;
  over_speed_ = false;
}

// Latches faults. Over-speed needs two ticks in a row and a force or torque along the motion: a hand may be fast on
// its own.
void OutputStage::latchFaults(const Input& input) noexcept {
  if (!input.command.f.allFinite() || !input.command.t.allFinite()) latches_ |= kOutputNotFinite;
  if (input.lost) latches_ |= kOutputLost;
  if (input.other_lost) latches_ |= kOutputOther;
  if (input.resumed) latches_ |= kOutputGap;
  const bool over_speed = (input.v_WH.norm() > limits_.speed && last_.f.dot(input.v_WH) > 0) ||
                          (input.w_WT.norm() > limits_.angular_speed && last_.t.dot(input.w_WT) > 0);
  if (over_speed && over_speed_) latches_ |= kOutputSpeed;
  over_speed_ = over_speed;
  if (latches_ == 0) good_ = input.command;
  status_ |= latches_;
}

// Scales by the largest component first: the square of 1e308 would overflow.
Vec3 OutputStage::clampMagnitude(Vec3 force, double max, OutputStatus sign) noexcept {
  if (const double largest = force.cwiseAbs().maxCoeff(); largest > max) {
    force *= max / largest;
    status_ |= sign;
  }
  if (const double norm = force.norm(); norm > max) {
    force *= max / norm;
    status_ |= sign;
  }
  return force;
}

Vec3 OutputStage::thermalLimit(const Part& part, const Vec3& force, const Vec3& last) noexcept {
  if (!limits_.records_overload) return clampMagnitude(force, part.budget.maxForce(part.max), kOutputWarm);
  if (last.norm() > part.continuous) status_ |= kOutputOverload;
  return force;
}

double OutputStage::fade(const Input& input, double period) noexcept {
  if (input.trust != Trust::kGood) status_ |= kOutputWatchdog;
  const bool dropped = latched() || input.trust == Trust::kDropped;
  gap_ = dropped ? gap_ + period : 0;
  if (latched() || gap_ > kShortGap) {
    gain_ = 0;
  } else if (!dropped) {
    const bool fading = input.stop || input.trust == Trust::kFading;
    gain_ = std::clamp(gain_ + (fading ? -period / limits_.fade_out : period / limits_.soft_start), 0.0, 1.0);
  }
  if (gain_ < 1 || dropped) status_ |= kOutputFading;
  return dropped ? 0 : gain_;
}

Vec3 OutputStage::slewLimit(const Vec3& force, const Vec3& last, double max) noexcept {
  const Vec3 change = force - last;
  const double length = change.norm();
  if (!(length > max)) return force;
  status_ |= kOutputSlew;
  return last + change * (max / length);
}

}  // namespace presa
