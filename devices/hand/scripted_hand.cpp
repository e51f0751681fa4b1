#include "devices/hand/scripted_hand.h"

#include <algorithm>
#include <cmath>

namespace presa {
namespace {

constexpr double kGripTime = 0.1;      // [s] time constant of the grip force correction
constexpr double kPositionRate = 3;    // [1/s] integral gain that carries a load without sagging
constexpr double kMaxCorrection = 20;  // [N] bound of each correction
constexpr double kPathStep = 0.01;     // [s]

}  // namespace

HandPush ScriptedHand::live(const Tick& tick) noexcept {
  // the target in the middle of the coming period: second-order accurate under zero-order hold
  const MotionTarget target = motion().at(tick.time + tick.period / 2);
  const Vec3 inward = target.inward_W;
  const bool gripping = inward.squaredNorm() > 0;

  Vec3 lag = target.p_WT - tip_.p_WH;
  if (gripping) {
    lag -= lag.dot(inward) * inward;
    const double against = -tip_.f_H_W.dot(inward);
    if (against > 0.05 * target.grip) grip_ += (target.grip - against) * tick.period / kGripTime;
  } else {
    grip_ -= grip_ * tick.period / kGripTime;
  }
  grip_ = std::clamp(grip_, -kMaxCorrection, kMaxCorrection);
  carry_ += settings_.impedance.stiffness * kPositionRate * tick.period * lag;
  if (const double norm = carry_.norm(); norm > kMaxCorrection) carry_ *= kMaxCorrection / norm;

  HandPush push{.p_WT = target.p_WT, .v_WT = target.v_WT, .force_W = target.force_W, .carry_W = carry_};
  if (gripping) push.grip_W = (target.grip + grip_) * inward;
  return push;
}

std::vector<Hand::Place> ScriptedHand::path() const {
  std::vector<Place> path;
  const double end = motion().phase_times.empty() ? 0 : motion().phase_times.back();
  const int last = std::max(0, static_cast<int>(std::ceil(end / kPathStep)));
  for (int i = 0; i <= last; ++i) {
    const double time = last > 0 ? end * i / last : 0;
    path.push_back({time, motion().at(time).p_WT});
  }
  return path;
}

}  // namespace presa
