#pragma once
#include <vector>

#include "experiments/study/prescribed_finger.h"
#include "framework/device/device_modules.h"

/// Fingers on exactly known paths.
namespace presa::stability {

/// Smooth step from 0 to 1 between `begin` and `end` [s], with its rate [1/s] (quintic: position, velocity and
/// acceleration are continuous).
struct Ramp {
  double value = 0, rate = 0;
};
Ramp ramp(double time, double begin, double end);

/// A pair of fingertips that closes along the x axis on a body `width` wide at `center`. Each fingertip penetrates by
/// `depth` between `close_begin` and `close_end`; the pair rises by `lift` between `lift_begin` and `lift_end`. Times
/// in s.
struct Pinch {
  Vec3 center = Vec3::Zero();  ///< of the grasp [m]
  double width = 0;            ///< of the body [m]
  double radius = 0.008;       ///< of the fingertips [m]
  double depth = 0;            ///< penetration of each finger, once closed [m]
  double open = 0.003;         ///< gap before closing [m]
  double close_begin = 0.05, close_end = 0.35;
  double lift = 0;  ///< [m]
  double lift_begin = 0.4, lift_end = 0.9;
  /// Motion added to both fingers from lift_end on, as a function of the time since then.
  std::function<PrescribedFinger::State(double time)> sway{};
};
/// Motion of one finger: side -1 is the thumb, +1 the index.
PrescribedFinger::State pinchState(const Pinch& pinch, double side, double time);
/// Thumb (-x), then index (+x).
DeviceList pinchFingers(const Pinch& pinch);

}  // namespace presa::stability
