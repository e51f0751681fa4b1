#include "devices/simulated_subject/model/perception.h"

#include <algorithm>
#include <cmath>

namespace presa::subject {
namespace {

constexpr double kFeelingTime = 0.05, kHabitTime = 0.4, kDriftTime = 0.1;  // [s]
constexpr double kStill = 1e-3;                                            // [m/s]
constexpr double kUnknownStiffness = 1000;                                 // [N/m] assumed until kClosing is reached
constexpr double kLightGrip = 4;     // [N] well below the force limit of the device
constexpr double kClosing = 0.3e-3;  // [m] standard deviation of the closing needed to estimate the stiffness

}  // namespace

void Perception::step(const Afferents& afferents) noexcept {
  afferents_ = afferents;
  const DigitAfferents &thumb = afferents.digits[0], &index = afferents.digits[1];
  grip_ += period_ * (0.5 * (thumb.normal + index.normal) - grip_) / kFeelingTime;
  load_ += period_ * (0.5 * (thumb.load + index.load) - load_) / kFeelingTime;
  height_ = 0.5 * (thumb.y + index.y);
  kick_ = height_ - usual_height_;
  usual_height_ += period_ * kick_ / kHabitTime;
  drift_ += period_ * (0.5 * (thumb.v_y + index.v_y) - drift_) / kDriftTime;
  opening_ = opening_ && (touching(0) || touching(1));
  if (touchesBoth()) {
    if (learning_ && std::max(thumb.normal, index.normal) < kLightGrip) learnStiffness();
    if (std::isnan(place_) && !opening_ && afferents.sight.object) place_ = afferents.sight.height;
  }
}

void Perception::learnStiffness() noexcept {
  const double q = afferents_.digits[0].q + afferents_.digits[1].q;
  const double n = afferents_.digits[0].normal + afferents_.digits[1].normal;
  count_ += 1;
  const double beside = q - mean_q_;
  mean_q_ += beside / count_;
  mean_n_ += (n - mean_n_) / count_;
  qq_ += beside * (q - mean_q_);
  qn_ += beside * (n - mean_n_);
}

double Perception::stiffness() const noexcept {
  return qq_ > kClosing * kClosing * count_ && qn_ > 0 ? qn_ / qq_ : kUnknownStiffness;
}

bool Perception::still() const noexcept { return std::abs(drift_) < kStill && !seenSliding(); }

std::optional<double> Perception::seenHeight() const noexcept {
  if (!afferents_.sight.object) return std::nullopt;
  return height_ + afferents_.sight.height;
}

std::optional<double> Perception::seenAside() const noexcept {
  if (!afferents_.sight.object) return std::nullopt;
  return afferents_.sight.aside;
}

double Perception::fallen() const noexcept {
  if (!afferents_.sight.object || std::isnan(place_)) return 0;
  return place_ - afferents_.sight.height - load_ / stiffness();
}

}  // namespace presa::subject
