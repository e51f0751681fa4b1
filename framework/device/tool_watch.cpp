#include "framework/device/tool_watch.h"

#include <cmath>

#include "framework/device/sample_check.h"

namespace presa {
namespace {

constexpr double kUnitRounding = 1e-6;  // of a unit quaternion

bool usable(const FrameMotion& tool) noexcept {
  return tool.X_WF.p.allFinite() && tool.v_WF.allFinite() && tool.w_WF.allFinite() &&
         std::abs(tool.X_WF.q.norm() - 1) <= kUnitRounding;
}

}  // namespace

bool ToolWatch::jumped(const Pose& measured, double time) const noexcept {
  const double since = time - last_time_;
  return (measured.p - last_.p).norm() > SampleCheck::kFastest * since + kUnitRounding ||
         measured.q.angularDistance(last_.q) > SampleCheck::kFastestTurn * since + kUnitRounding;
}

void ToolWatch::update(const FrameMotion& measured, bool valid, double time) noexcept {
  if (!valid || !usable(measured)) {
    motion_.v_WF.setZero();
    motion_.w_WF.setZero();
    missed_ = true;
    if (!lost_ && time - last_time_ > kLongest) {
      lost_ = true;
      ++losses_;
    }
    return;
  }
  if (known_ && (missed_ || jumped(measured.X_WF, time))) {
    returns_ = lost_ || (returns_ && !back_.over(time));
    back_.begin(motion_.X_WF, measured.X_WF, time);
  }
  returns_ = returns_ && !back_.over(time);
  known_ = true;
  missed_ = lost_ = false;
  last_ = measured.X_WF;
  last_time_ = time;
  motion_ = back_.at(measured, time);
}

}  // namespace presa
