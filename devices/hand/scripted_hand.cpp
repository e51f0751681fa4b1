#include "devices/hand/scripted_hand.h"

#include <algorithm>

namespace presa {
namespace {

constexpr double kGripTime = 0.1;      // [s] time constant of the grip force correction
constexpr double kPositionRate = 3;    // [1/s] integral gain that carries a load without sagging
constexpr double kMaxCorrection = 20;  // [N] bound of each correction

}  // namespace

MotionTarget ScriptedHand::live(double time, double period, const Vec3& p_WH, const Vec3& felt, Vec3& force) noexcept {
  // the target in the middle of the coming period: second-order accurate under zero-order hold
  MotionTarget target = motion_->at(time + period / 2);
  const Vec3 inward = target.inward_W;
  const bool gripping = inward.squaredNorm() > 0;

  Vec3 lag = target.p_WT - p_WH;
  if (gripping) {
    lag -= lag.dot(inward) * inward;
    const double against = -felt.dot(inward);
    if (against > 0.05 * target.grip) grip_ += (target.grip - against) * period / kGripTime;
  } else {
    grip_ -= grip_ * period / kGripTime;
  }
  grip_ = std::clamp(grip_, -kMaxCorrection, kMaxCorrection);
  carry_ += stiffness_ * kPositionRate * period * lag;
  if (const double norm = carry_.norm(); norm > kMaxCorrection) carry_ *= kMaxCorrection / norm;

  force = force + target.force_W + carry_;
  if (gripping) force += (target.grip + grip_) * inward;
  return target;
}

}  // namespace presa
