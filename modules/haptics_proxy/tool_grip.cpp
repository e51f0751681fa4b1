#include "modules/haptics_proxy/tool_grip.h"

namespace presa {

double ToolGrip::step(const FingerInput& input, double period, ToolState& state) noexcept {
  const bool pressed = (input.buttons & bit_) != 0, switched = pressed && !pressed_;
  pressed_ = pressed;
  if (fade_ >= 0) {
    fade_ -= period;
    state.lies = fade_ < 0;
  } else if (switched && state.lies) {
    pickUp({input.p_WH, input.q_WT}, state);
  } else if (switched) {
    fade_ = kFade;
  }
  return state.lies ? 0 : fade_ < 0 ? 1 : fade_ / kFade;
}

void ToolGrip::pickUp(const Pose& X_WH, ToolState& state) noexcept {
  const Vec3 handle_T = state.X_WT.inverseTimes(X_WH.p);
  if ((handle_T - handle_T.cwiseMax(box_T_.low).cwiseMin(box_T_.high)).norm() > kReach) return;
  state.X_HT = X_WH.inverse() * state.X_WT;
  state.lies = state.alive = false;  // the renderer begins anew at this pose
}

}  // namespace presa
