#include "devices/simulated_subject/model/hand.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace presa::subject {
namespace {

constexpr double kNoisePeriod = 5e-3;                 // [s]
constexpr double kTremorRate = 10, kTremorWidth = 2;  // [Hz]

}  // namespace

MotorNoise::MotorNoise(const Traits& traits, RandomStream stream, double period)
    : traits_(traits),
      stream_(stream),
      ticks_per_value_(std::max(1, static_cast<int>(std::lround(kNoisePeriod / period)))) {
  const double step = ticks_per_value_ * period;
  keep_ = std::exp(-step / traits.noise_time);
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
  const double common = std::sqrt(traits_.noise_shared), apart = std::sqrt(1 - traits_.noise_shared);
  shared_ = keep_ * shared_ + add_ * stream_.normal();
  for (int i = 0; i < kDigits; ++i) {
    own_[i] = keep_ * own_[i] + add_ * stream_.normal();
    Tremor& tremor = tremor_[i];
    const double next = tremor_now_ * tremor.now + tremor_before_ * tremor.before + tremor_add_ * stream_.normal();
    tremor = {next, tremor.now};
    position_[i] = keep_ * position_[i] + add_ * traits_.position_noise * stream_.normal();
    force_[i] = (traits_.force_cv * grip + traits_.force_noise) * (common * shared_ + apart * own_[i]) +
                traits_.tremor * grip * tremor.now;
  }
}

Hand::Hand(const Traits& traits, RandomStream noise, double period, double q)
    : traits_(traits), period_(period), mass_(traits.hand_mass + traits.device_mass), noise_(traits, noise, period) {
  for (Digit& digit : digits_) digit.q = digit.anchor = q;
}

void Hand::step(const Intent& intent, const std::array<DigitSenses, kDigits>& felt) noexcept {
  noise_.step(intent.grip);
  const double arm = traits_.arm_stiffness * (sway() - intent.aside);
  const double level = -traits_.level_stiffness * 0.5 * (digits_[0].y - digits_[1].y);
  for (int i = 0; i < kDigits; ++i) {
    Digit& digit = digits_[i];
    const double side = i == 0 ? 1 : -1;
    if (intent.reaching) digit.anchor = intent.reach + side * intent.aside;
    const double along = (intent.grip + noise_.force(i)) * intent.gain +
                         traits_.grip_stiffness * (digit.anchor + noise_.position(i) - digit.q) -
                         traits_.grip_damping * digit.v_q - felt[i].normal - side * arm;
    digit.v_q += period_ * along / mass_;
    digit.q += period_ * digit.v_q;
    if (traits_.muscle_time > 0) digit.anchor += period_ * (digit.q - digit.anchor) / traits_.muscle_time;
    const double up = traits_.posture_stiffness * (intent.height - digit.y) + lift_ + side * level -
                      traits_.posture_damping * digit.v_y - felt[i].load;
    digit.v_y += period_ * up / mass_;
    digit.y += period_ * digit.v_y;
  }
  lift_ += period_ * intent.height_rate * traits_.posture_stiffness * (intent.height - meanHeight());
}

void Hand::place(double depth) noexcept {
  const double sway = this->sway();
  for (int i = 0; i < kDigits; ++i) {
    Digit& digit = digits_[i];
    digit.q = depth + (i == 0 ? sway : -sway);
    if (traits_.muscle_time > 0) digit.anchor = digit.q;
    digit.v_q = digit.v_y = 0;
  }
}

}  // namespace presa::subject
