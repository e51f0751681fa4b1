#include "framework/device/output_stage.h"

#include <algorithm>
#include <cmath>

namespace presa {
namespace {

// Whether a position [m] or a velocity [m/s] is finite and below 1000 in every component.
bool plausible(const Vec3& v) { return v.allFinite() && v.cwiseAbs().maxCoeff() < 1e3; }

}  // namespace

OutputStage::OutputStage(const OutputLimits& limits)
    : limits_(limits), budget_(limits.continuous, limits.heating_time) {}

Vec3 OutputStage::step(const Input& input, double period) noexcept {
  status_ = kOutputClean;
  budget_.step(last_.norm(), period);
  latchFaults(input);
  Vec3 force = clampMagnitude(good_, limits_.force, kOutputMagnitude);
  if (limits_.passivity && plausible(input.p_WH) && plausible(input.v_WH)) {
    force = energy_.step(force, input.p_WH, input.v_WH, period);
    if (energy_.acting()) status_ |= kOutputDamped;
    force = clampMagnitude(force, limits_.force, kOutputMagnitude);
  }
  force = thermalLimit(force) * fade(input, period);
  last_ = slewLimit(force, input.catch_up ? 0 : limits_.force_rate * period);
  if (limits_.passivity) energy_.sent(last_);
  return last_;
}

void OutputStage::rearm() noexcept {
  latches_ = 0;
  good_.setZero();
  gain_ = 0;
  over_speed_ = false;
}

// Latches faults. Over-speed needs two ticks in a row and a force along the motion: a hand may be fast on its own.
void OutputStage::latchFaults(const Input& input) noexcept {
  if (!input.command.allFinite()) latches_ |= kOutputNotFinite;
  if (input.lost) latches_ |= kOutputLost;
  if (input.other_lost) latches_ |= kOutputOther;
  if (input.resumed) latches_ |= kOutputGap;
  const bool over_speed = input.v_WH.norm() > limits_.speed && last_.dot(input.v_WH) > 0;
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

Vec3 OutputStage::thermalLimit(const Vec3& force) noexcept {
  if (!limits_.records_overload) return clampMagnitude(force, budget_.maxForce(limits_.force), kOutputWarm);
  if (last_.norm() > limits_.continuous) status_ |= kOutputOverload;
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

Vec3 OutputStage::slewLimit(const Vec3& force, double max) noexcept {
  const Vec3 change = force - last_;
  const double length = change.norm();
  if (!(length > max)) return force;
  status_ |= kOutputSlew;
  return last_ + change * (max / length);
}

}  // namespace presa
