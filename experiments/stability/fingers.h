#pragma once
#include <vector>

#include "framework/device/device_modules.h"
#include "experiments/study/prescribed_finger.h"

/// Fingers whose way is known exactly.
namespace presa::stability {

/// Smooth step from 0 to 1 between `begin` and `end` (quintic: position, velocity and acceleration are continuous), with
/// its rate.
struct Ramp {
  double value = 0, rate = 0;
};
Ramp ramp(double time, double begin, double end);

/// A pair of fingertips that closes along the x axis on a body `width` wide at `center`, goes `depth` into it from both
/// sides between `close_begin` and `close_end`, and carries it up by `lift` between `lift_begin` and `lift_end`.
struct Pinch {
  Vec3 center = Vec3::Zero();  ///< of the grasp [m]
  double width = 0;            ///< of the body [m]
  double radius = 0.008;       ///< of the fingertips [m]
  double depth = 0;            ///< of each finger in the body, once closed [m]
  double open = 0.003;         ///< gap before [m]
  double close_begin = 0.05, close_end = 0.35;
  double lift = 0;  ///< [m]
  double lift_begin = 0.4, lift_end = 0.9;
  /// Added to both fingers from lift_end on: displacement and velocity along any axis.
  std::function<PrescribedFinger::State(double time)> sway{};
};
/// Way of one of the two: side -1 is the thumb, +1 the index.
PrescribedFinger::State pinchState(const Pinch& pinch, double side, double time);
/// Thumb (-x), then index (+x).
DeviceList pinchFingers(const Pinch& pinch);

}  // namespace presa::stability
