#include "devices/pointer/pair.h"

#include <algorithm>
#include <cmath>

namespace presa::pointer {
namespace {

constexpr double kTouch = 0.05;  // [N]: force on both fingers that counts as an object between them

double signOf(std::size_t side) { return side == Pair::kThumb ? -1 : 1; }

}  // namespace

Pair::Pair(const PairSettings& settings)
    : settings_(settings),
      wanted_(settings.start),
      centre_(settings.start, kSpeed, kArrive),
      yaw_(0, kTurn, kArrive),
      half_(openHalf(), kClose, kArrive) {}

bool Pair::add(Side side, double stiffness) {
  if (fingers_[side]) return false;
  fingers_[side].emplace();
  fingers_[side]->tip.p_WH = start(side);
  stiffness_ = stiffness_ > 0 ? std::min(stiffness_, stiffness) : stiffness;
  return true;
}

Vec3 Pair::start(Side side) const noexcept { return settings_.start + signOf(side) * openHalf() * Vec3::UnitX(); }

void Pair::point(const PointerState& pointer) noexcept {
  if (pointer.sequence == 0 || !pointer.p_WT.allFinite()) return;
  wanted_ = pointer.p_WT;
  if (std::isfinite(pointer.yaw)) wanted_yaw_ = pointer.yaw;
  if (std::isfinite(pointer.closing)) closing_ = std::clamp(pointer.closing, 0.0, 1.0);
}

const HandPush& Pair::live(Side side, const Tick& tick) noexcept {
  for (; planned_ <= tick.index; ++planned_) plan(tick.period);
  return fingers_[side]->push;
}

bool Pair::holds(const Vec3& along) const noexcept {
  for (std::size_t side : {kThumb, kIndex}) {
    if (!fingers_[side] || fingers_[side]->tip.f_H_W.dot(signOf(side) * along) < kTouch) return false;
  }
  return true;
}

double Pair::halfWidth(const Vec3& along) const noexcept {
  double width = 0;
  int fingers = 0;
  for (std::size_t side : {kThumb, kIndex}) {
    if (!fingers_[side]) continue;
    width += signOf(side) * (fingers_[side]->tip.p_WH - centre_.value()).dot(along);
    ++fingers;
  }
  return width / std::max(fingers, 1);
}

Vec3 Pair::middle(const Vec3& along) const noexcept {
  Vec3 sum = Vec3::Zero();
  int fingers = 0;
  for (std::size_t side : {kThumb, kIndex}) {
    if (!fingers_[side]) continue;
    sum += fingers_[side]->tip.p_WH - signOf(side) * half_.value() * along;
    ++fingers;
  }
  return fingers > 0 ? Vec3(sum / fingers) : centre_.value();
}

void Pair::plan(double period) noexcept {
  centre_.step(wanted_, period);
  yaw_.step(wanted_yaw_, period);
  const Vec3 along(std::cos(yaw_.value()), std::sin(yaw_.value()), 0), across(-along.y(), along.x(), 0);
  // fully closed, the target lies inside the object, as deep as the springs need for the full grip
  const double deepest = settings_.grip / stiffness_;
  double half = openHalf() - closing_ * (openHalf() + deepest);
  if (!holds(along)) half = std::max(half, settings_.fingertip);  // fingertips stop at each other
  half_.step(half, period);
  const double min = halfWidth(along) - deepest;
  const bool bounded = half_.value() < min;
  const double reach = bounded ? min : half_.value(), closing = bounded ? 0 : half_.rate();
  // against a fixed obstacle, bound the pull of the springs
  Vec3 lead = centre_.value() - middle(along), rate = centre_.rate();
  if (const double max = settings_.push / stiffness_, length = lead.norm(); length > max) {
    lead *= max / length;
    rate.setZero();
  }
  const Vec3 centre = middle(along) + lead;
  for (std::size_t side : {kThumb, kIndex}) {
    if (!fingers_[side]) continue;
    const double sign = signOf(side);
    fingers_[side]->push = {.p_WT = centre + sign * reach * along,
                            .v_WT = rate + sign * (closing * along + reach * yaw_.rate() * across)};
  }
}

}  // namespace presa::pointer
