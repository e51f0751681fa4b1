#include "devices/simulated_subject/model/hand.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace presa::subject {
namespace {

constexpr double kNoisePeriod = 5e-3;                 // [s]
constexpr double kTremorRate = 10, kTremorWidth = 2;  // [Hz]

}  // namespace

MotorNoise::MotorNoise(const SubjectParameters& parameters, RandomStream stream, double period)
    : parameters_(parameters),
      stream_(stream),
      ticks_per_value_(std::max(1, static_cast<int>(std::lround(kNoisePeriod / period)))) {
  const double step = ticks_per_value_ * period;
  keep_ = std::exp(-step / parameters.noise_time);
  add_ = std::sqrt(1 - keep_ * keep_);
  const double radius = std::exp(-std::numbers::pi * kTremorWidth * step);
  tremor_now_ = 2 * radius * std::cos(2 * std::numbers::pi * kTremorRate * step);
  tremor_before_ = -radius * radius;
  // variance of a second-order autoregression [Box & Jenkins]
  const double a = tremor_now_, b = tremor_before_;
  tremor_add_ = std::sqrt((1 + b) * ((1 - b) * (1 - b) - a * a) / (1 - b));
}

void MotorNoise::step(double grip) noexcept {
  if (tick_ == 0) renew(grip);
  tick_ = (tick_ + 1) % ticks_per_value_;
}

void MotorNoise::renew(double grip) noexcept {
  const double common = std::sqrt(parameters_.noise_shared), apart = std::sqrt(1 - parameters_.noise_shared);
  shared_ = keep_ * shared_ + add_ * stream_.normal();
  for (int i = 0; i < kDigits; ++i) {
    own_[i] = keep_ * own_[i] + add_ * stream_.normal();
    Tremor& tremor = tremor_[i];
    const double next = tremor_now_ * tremor.now + tremor_before_ * tremor.before + tremor_add_ * stream_.normal();
    tremor = {next, tremor.now};
    position_[i] = keep_ * position_[i] + add_ * parameters_.position_noise * stream_.normal();
    force_[i] = (parameters_.force_cv * grip + parameters_.force_noise) * (common * shared_ + apart * own_[i]) +
                parameters_.tremor * grip * tremor.now;
  }
}

Hand::Hand(const SubjectParameters& parameters, RandomStream noise, double period, double q)
    : parameters_(parameters),
      period_(period),
      mass_(parameters.hand_mass + parameters.device_mass),
      noise_(parameters, noise, period) {
  for (Digit& digit : digits_) digit.q = digit.anchor = q;
}

std::array<Hand::Push, kDigits> Hand::pushAgainst(const MotorCommand& command,
                                                  const std::array<DigitAfferents, kDigits>& felt) {
  noise_.step(command.grip);
  const double arm = parameters_.arm_stiffness * (sway() - command.aside);
  const double level = -parameters_.level_stiffness * 0.5 * (digits_[0].y - digits_[1].y);
  std::array<Push, kDigits> pushes;
  for (int i = 0; i < kDigits; ++i) {
    Digit& digit = digits_[i];
    const double side = i == 0 ? 1 : -1;
    if (command.reaching) digit.anchor = command.reach + side * command.aside;
    pushes[i].along = (command.grip + noise_.force(i)) * command.gain +
                      parameters_.grip_stiffness * (digit.anchor + noise_.position(i) - digit.q) -
                      parameters_.grip_damping * digit.v_q - felt[i].normal - side * arm;
    pushes[i].up = parameters_.posture_stiffness * (command.height - digit.y) + lift_ + side * level -
                   parameters_.posture_damping * digit.v_y - felt[i].load;
  }
  return pushes;
}

void Hand::relax(Digit& digit) noexcept {
  if (parameters_.muscle_time > 0) digit.anchor += period_ * (digit.q - digit.anchor) / parameters_.muscle_time;
}

void Hand::lift(const MotorCommand& command) noexcept {
  lift_ += period_ * command.height_rate * parameters_.posture_stiffness * (command.height - meanHeight());
}

void Hand::step(const MotorCommand& command, const std::array<DigitAfferents, kDigits>& felt) noexcept {
  const std::array<Push, kDigits> pushes = pushAgainst(command, felt);
  for (int i = 0; i < kDigits; ++i) {
    Digit& digit = digits_[i];
    digit.v_q += period_ * pushes[i].along / mass_;
    digit.q += period_ * digit.v_q;
    relax(digit);
    digit.v_y += period_ * pushes[i].up / mass_;
    digit.y += period_ * digit.v_y;
  }
  lift(command);
}

std::array<Hand::Push, kDigits> Hand::push(const MotorCommand& command,
                                           const std::array<Place, kDigits>& places) noexcept {
  for (int i = 0; i < kDigits; ++i) {
    static_cast<Place&>(digits_[i]) = places[i];
    relax(digits_[i]);
  }
  const std::array<Push, kDigits> pushes = pushAgainst(command, {});
  lift(command);
  return pushes;
}

void Hand::place(double depth) noexcept {
  const double sway = this->sway();
  for (int i = 0; i < kDigits; ++i) {
    Digit& digit = digits_[i];
    digit.q = depth + (i == 0 ? sway : -sway);
    if (parameters_.muscle_time > 0) digit.anchor = digit.q;
    digit.v_q = digit.v_y = 0;
  }
}

}  // namespace presa::subject
