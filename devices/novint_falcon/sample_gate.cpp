#include "devices/novint_falcon/sample_gate.h"

#include <algorithm>
#include <cmath>

#include "devices/novint_falcon/kinematics.h"

namespace presa::falcon {

void SampleGate::reset() noexcept {
  empty_ = true;
  doubted_ = false;
  v_DH_.setZero();
}

void SampleGate::unsettle(double asked, double now) noexcept {
  if (now >= unsettled_until_) unsettled_since_ = asked;
  unsettled_until_ = now + kVelocityGap;
}

SampleGate::Verdict SampleGate::take(const Counts& encoders, double time) noexcept {
  const auto p_DH = direct(thighAngles(encoders), empty_ ? kCentre : p_DH_);
  const bool unsettled = time < unsettled_until_;
  const double since = unsettled ? std::min(time_, std::max(unsettled_since_, time - kVelocityGap)) : time_;
  const double elapsed = time - since;
  const bool possible =
      p_DH && p_DH->allFinite() && (empty_ || (*p_DH - p_DH_).norm() <= max_speed_ * std::max(elapsed, period_));
  if (!possible) {
    ++rejected_;
    const bool second = doubted_;
    doubted_ = true;
    return second ? Verdict::kLatched : Verdict::kRejected;
  }
  if (empty_ || unsettled || elapsed > kVelocityGap) {
    v_DH_.setZero();
  } else if (elapsed > 0) {
    const double share = 1 - std::exp(-elapsed / kVelocityTime);
    v_DH_ += share * ((*p_DH - p_DH_) / elapsed - v_DH_);
  }
  p_DH_ = *p_DH;
  time_ = time;
  empty_ = doubted_ = false;
  return Verdict::kGood;
}

}  // namespace presa::falcon
