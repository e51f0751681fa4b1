#include "framework/walls/head_watch.h"

#include <cmath>

namespace presa::walls {
namespace {

constexpr double kNoise = 0.02;  ///< [m] a jump below it is a tracker's noise

bool usable(const Pose& pose) {
  constexpr double kRounding = 1e-3;  // of a tracker's unit quaternion
  return pose.p.allFinite() && std::abs(pose.q.norm() - 1) < kRounding;
}

}  // namespace

bool HeadWatch::jumped(const Pose& measured, double time) const noexcept {
  return (measured.p - last_.p).norm() > kNoise + kFastest * (time - last_time_);
}

const Pose& HeadWatch::update(const Pose& measured, bool valid, double time) noexcept {
  if (!valid || !usable(measured)) {
    if (!lost_ && time - last_time_ > kLongest) {
      lost_ = true;
      ++losses_;
    }
    return pose_;
  }
  if (lost_ || !known_ || jumped(measured, time)) back_.begin(pose_, measured, time);
  lost_ = false;
  known_ = true;
  last_ = measured;
  last_time_ = time;
  pose_ = back_.at({.X_WF = measured}, time).X_WF;
  pose_.q.normalize();
  return pose_;
}

}  // namespace presa::walls
