#include "devices/pointer/stylus.h"

#include <cmath>

namespace presa::pointer {

Stylus::Stylus(const Vec3& start, double push, const FingerImpedance& impedance, double period)
    : lead_(push / impedance.stiffness),
      tip_(impedance, period),
      turn_({}, period),
      wanted_(start),
      place_(start, kSpeed, kArrive),
      yaw_(0, kTurn, kArrive),
      tilt_(0, kTurn, kArrive) {
  tip_.reset(start);
}

void Stylus::point(const PointerState& pointer) noexcept {
  if (pointer.sequence == 0 || !pointer.p_WT.allFinite()) return;
  wanted_ = pointer.p_WT;
  if (std::isfinite(pointer.yaw)) wanted_yaw_ = pointer.yaw;
  if (std::isfinite(pointer.tilt)) wanted_tilt_ = pointer.tilt;
  buttons_ = pointer.buttons;
}

void Stylus::advance(const Tick& tick) noexcept {
  for (; at_.index < tick.index; ++at_.index) {
    place_.step(wanted_, tick.period);
    yaw_.step(wanted_yaw_, tick.period);
    tilt_.step(wanted_tilt_, tick.period);
    Vec3 lead = place_.value() - tip_.position(), rate = place_.rate();
    if (const double length = lead.norm(); length > lead_) {
      lead *= lead_ / length;
      rate.setZero();
    }
    tip_.step(tip_.position() + lead, rate, held_.f);
    turn_.step(held_.t);
  }
  at_ = tick;
}

// Tilt about y first, then yaw about z: the pen leans in the direction of the yaw.
Quat Stylus::wantedOrientation() const noexcept {
  return Quat(Eigen::AngleAxisd(yaw_.value(), Vec3::UnitZ()) * Eigen::AngleAxisd(tilt_.value(), Vec3::UnitY()));
}

Vec3 Stylus::wantedRate() const noexcept {
  return {-tilt_.rate() * std::sin(yaw_.value()), tilt_.rate() * std::cos(yaw_.value()), yaw_.rate()};
}

FingerInput Stylus::sample() const noexcept {
  FingerInput sample{tip_.position(), tip_.velocity(), -1, true};
  sample.oriented = true;
  sample.buttons = buttons_;
  sample.q_WT = turn_.orientation(wantedOrientation());
  sample.w_WT = turn_.rate(wantedRate());
  return sample;
}

}  // namespace presa::pointer
