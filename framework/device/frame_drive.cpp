#include "framework/device/frame_drive.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace presa {
namespace {

Vec3 towards(const Vec3& from, const Vec3& to, double step) noexcept {
  const Vec3 way = to - from;
  const double length = way.norm();
  return length <= step ? to : Vec3(from + way * (step / length));
}

}  // namespace

FrameDrive::FrameDrive(const Frame& frame)
    : moves_(frame.moves),
      speed_(frame.speed),
      turn_(frame.turn),
      drift_(frame.drift),
      has_clutch_(frame.clutch.has_value()),
      zoom_(frame.zoom) {}

std::uint32_t FrameDrive::asked(const FrameWish& wish) const noexcept {
  std::uint32_t bits = 0;
  const bool walks = moves_ != Frame::Moves::kNot && (!wish.walk.isZero() || wish.turn != 0);
  if (walks || !drift_.isZero()) bits |= kFrameWalks;
  if (has_clutch_ && wish.clutch) bits |= kFrameClutched;
  if (zoom_ && wish.zoom != 0) bits |= kFrameZooms;
  return bits;
}

/// A wish counts once, and once more if it had to wait or was taken back.
void FrameDrive::count(std::uint32_t asked, bool refused) noexcept {
  now_.uses += static_cast<std::uint32_t>(std::popcount(asked & ~asked_));
  asked_ = asked;
  refused_ &= asked;
  if (!refused) return;
  now_.refusals += static_cast<std::uint32_t>(std::popcount(asked & ~refused_));
  refused_ |= asked;
}

void FrameDrive::rest() noexcept {
  walking_.setZero();
  turning_ = 0;
  anchor_.reset();
}

void FrameDrive::step(const FrameWish& wish, const std::optional<Hand>& hand, Touch touch, double period) noexcept {
  rates_ = {};
  now_.doing = 0;
  if (changed_ && !touch.written) return;  // nobody has answered yet
  if (changed_ && touch.felt) {
    place_ = free_;
    pause_ = kPause;
  }
  changed_ = false;
  free_ = place_;
  const std::uint32_t wants = asked(wish);
  const bool waits = touch.felt || pause_ > 0;
  pause_ = std::max(0.0, pause_ - period);
  count(wants, waits);
  if (waits) {
    rest();
    if (wants != 0) now_.doing = kFrameWaits;
  } else {
    walk(wish, period);
    slide(wish, hand, period);
  }
  now_.zoom = place_.s;
}

void FrameDrive::walk(const FrameWish& wish, double period) noexcept {
  if (moves_ == Frame::Moves::kNot && drift_.isZero()) return;
  Vec3 wanted = Vec3::Zero();
  if (moves_ != Frame::Moves::kNot) wanted = speed_ * wish.walk;
  if (moves_ == Frame::Moves::kWalk) wanted.z() = 0;
  const double turn = moves_ == Frame::Moves::kNot ? 0 : turn_ * wish.turn;
  const double share = period / kStart;
  walking_ = towards(walking_, wanted + drift_, share * (speed_ + drift_.norm()));
  turning_ += std::clamp(turn - turning_, -share * turn_, share * turn_);
  if (walking_.isZero() && turning_ == 0) return;
  rates_.v = place_.X_FU.q * walking_;
  rates_.turn = turning_;
  place_.X_FU.p += period * rates_.v;
  place_.X_FU.q = (place_.X_FU.q * Quat(Eigen::AngleAxisd(period * turning_, Vec3::UnitZ()))).normalized();
  changed_ = true;
  now_.doing |= kFrameWalks;
}

void FrameDrive::slide(const FrameWish& wish, const std::optional<Hand>& hand, double period) noexcept {
  const double before = place_.s;
  const Vec3 at = hand ? hand->p : Vec3::Zero();
  const bool clutched = has_clutch_ && wish.clutch && hand;
  if (!clutched) anchor_.reset();
  if (clutched && !anchor_) anchor_ = place_.c + before * at;
  if (zoom_ && wish.zoom != 0) {
    place_.s = std::clamp(before * std::pow(zoom_->rate, wish.zoom * period), zoom_->min, zoom_->max);
    rates_.s = (place_.s - before) / period;
  }
  const bool zooms = place_.s != before;
  if (!clutched && !zooms) return;
  place_.c = anchor_ ? Vec3(*anchor_ - place_.s * at) : Vec3(place_.c + (before - place_.s) * at);
  rates_.c = -rates_.s * at;
  if (anchor_) rates_.c -= place_.s * hand->v;
  changed_ = true;
  now_.doing |= (clutched ? kFrameClutched : 0U) | (zooms ? kFrameZooms : 0U);
}

FrameMotion FrameDrive::motion() const noexcept {
  const FrameMotion user{.X_WF = place_.X_FU, .v_WF = rates_.v, .w_WF = rates_.turn * Vec3::UnitZ()};
  const FrameMotion hand{.X_WF = {place_.c, Quat::Identity()}, .v_WF = rates_.c, .scale = place_.s, .growth = rates_.s};
  return user * hand;
}

}  // namespace presa
