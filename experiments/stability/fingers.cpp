#include "experiments/stability/fingers.h"

namespace presa::stability {

Ramp ramp(double time, double begin, double end) {
  if (time <= begin) return {0, 0};
  if (time >= end) return {1, 0};
  const double span = end - begin, s = (time - begin) / span;
  return {s * s * s * (10 + s * (-15 + 6 * s)), 30 * s * s * (1 - s) * (1 - s) / span};
}

PrescribedFinger::State pinchState(const Pinch& pinch, double side, double time) {
  const Ramp close = ramp(time, pinch.close_begin, pinch.close_end);
  const Ramp lift = ramp(time, pinch.lift_begin, pinch.lift_end);
  const double travel = pinch.open + pinch.depth;
  const double x = pinch.width / 2 + pinch.radius + pinch.open - travel * close.value;
  PrescribedFinger::State state{pinch.center + Vec3(side * x, 0, pinch.lift * lift.value),
                                Vec3(-side * travel * close.rate, 0, pinch.lift * lift.rate)};
  if (pinch.sway && time > pinch.lift_end) {
    const PrescribedFinger::State sway = pinch.sway(time - pinch.lift_end);
    state.p_WH += sway.p_WH;
    state.v_WH += sway.v_WH;
  }
  return state;
}

DeviceList pinchFingers(const Pinch& pinch) {
  DeviceList fingers;
  for (const double side : {-1.0, 1.0}) {
    fingers.push_back(
        std::make_unique<PrescribedFinger>([pinch, side](double time) { return pinchState(pinch, side, time); }));
  }
  return fingers;
}

}  // namespace presa::stability
