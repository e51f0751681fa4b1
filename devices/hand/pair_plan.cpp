#include "devices/hand/pair_plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/device/minimum_jerk.h"

namespace presa {
namespace {

constexpr double kTurn = 1;            // [rad/s]
constexpr double kPeakOfMean = 1.875;  // peak over mean speed of a minimum-jerk movement
constexpr double kMinDuration = 0.2;   // min duration of a movement [s]

double wrapped(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

}  // namespace

void PairPlan::see(const ObjectState& objects, double time) noexcept {
  now_ = time;
  if (time >= end_) next(objects);
}

void PairPlan::go(int phase, const PairTarget& to, double duration) noexcept {
  phase_ = phase;
  from_ = to_;
  from_.grip = to.grip > 0 && to_.grip <= 0 ? 0 : to_.grip;
  to_ = to;
  to_.yaw = from_.yaw + wrapped(to.yaw - from_.yaw);
  begin_ = now_;
  end_ = now_ + duration;
}

void PairPlan::goAt(int phase, const PairTarget& to, double speed) noexcept {
  const double way = (to.centre - to_.centre).norm(), turn = std::abs(wrapped(to.yaw - to_.yaw));
  go(phase, to, kMinDuration + kPeakOfMean * std::max(way / speed, turn / kTurn));
}

PairTarget PairPlan::at(double time) const noexcept {
  const double s = end_ > begin_ ? minimumJerk((time - begin_) / (end_ - begin_)) : 1;
  return {from_.centre + s * (to_.centre - from_.centre), from_.yaw + s * (to_.yaw - from_.yaw),
          from_.gap + s * (to_.gap - from_.gap), from_.grip + s * (to_.grip - from_.grip)};
}

PairTarget PairPlan::rate(double time) const noexcept {
  if (!(end_ > begin_)) return {};
  const double slope = minimumJerkSlope((time - begin_) / (end_ - begin_)) / (end_ - begin_);
  return {slope * (to_.centre - from_.centre), slope * (to_.yaw - from_.yaw), slope * (to_.gap - from_.gap), 0};
}

}  // namespace presa
