// What a fingertip judges of a surface. Texture: the force that a device holds is constant from tick to tick, so that a
// first-order high-pass and a first-order low-pass of it have closed forms, at any haptic rate:
//   s' = (u - s) / a,  y' = (u - s - y) / b,  a = 1 / (2 pi 40 Hz),  b = 1 / (2 pi 400 Hz)
//   y(t) = y(0) exp(-t/b) + (u - s(0)) (exp(-t/a) - exp(-t/b)) a / (a - b)
#include "apps/studies/cost/felt_metrics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/studies/cost/comparison.h"

namespace presa::cost {
namespace {

constexpr double kPressed = 5e-5;         ///< smallest stretch at which stiffness is judged [m]
constexpr double kLow = 40, kHigh = 400;  ///< band of textures [Hz]
constexpr double kSlow = 0.5 / (std::numbers::pi * kLow), kFast = 0.5 / (std::numbers::pi * kHigh);  ///< [s]
constexpr double kSample = 0.00025;  ///< longest time between two samples of the band [s]

double norm(const double (&v)[3]) { return std::hypot(v[0], v[1], v[2]); }

/// The band of one component of a held force.
struct Band {
  double slow = 0, out = 0;
  void hold(double force, double gone_slow, double gone_fast) {
    const double rest = force - slow;
    out = out * gone_fast + rest * (gone_slow - gone_fast) * kSlow / (kSlow - kFast);
    slow = force - rest * gone_slow;
  }
};

/// RMS of the band over the compared window [N].
Value vibration(const Evidence& e, std::size_t finger) {
  const Trace& trace = e.trace;
  Band band[3];
  double squares = 0, time = 0;
  for (std::size_t i = 0; i + 1 < trace.held_from_ns.size(); ++i) {
    const double begin = 1e-9 * static_cast<double>(trace.held_from_ns[i]);
    const double held = 1e-9 * static_cast<double>(trace.held_from_ns[i + 1] - trace.held_from_ns[i]);
    const int samples = std::max(1, static_cast<int>(std::ceil(held / kSample - 1e-9)));
    const double step = held / samples, gone_slow = std::exp(-step / kSlow), gone_fast = std::exp(-step / kFast);
    const bool counts = begin >= e.compared_from && begin < e.compared_to;
    for (int k = 0; k < samples; ++k) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        band[axis].hold(static_cast<double>(trace.held[i * trace.fingers + finger][axis]), gone_slow, gone_fast);
      if (!counts) continue;
      for (const Band& each : band) squares += each.out * each.out * step;
      time += step;
    }
  }
  return time > 0 ? Value(std::sqrt(squares / time)) : std::nullopt;
}

}  // namespace

std::optional<double> torqueError(const Evidence& setting, const Evidence& reference) {
  const auto error = [](const FingerSample& a, const FingerSample& b) -> Value {
    if (!(a.touching > 0 || b.touching > 0)) return std::nullopt;
    return 1e3 * std::hypot(a.torque[0] - b.torque[0], a.torque[1] - b.torque[1], a.torque[2] - b.torque[2]);
  };
  return worstFinger(setting, reference, error, &Sum::rms);
}

std::optional<double> stiffnessError(const Evidence& setting, const Evidence& reference) {
  const auto error = [](const FingerSample& a, const FingerSample& b) -> Value {
    const double right = norm(b.force);
    if (!(a.touching > 0 && b.touching > 0 && a.stretch > kPressed && b.stretch > kPressed && right > 0))
      return std::nullopt;
    return 100 * std::abs(norm(a.force) / a.stretch * b.stretch / right - 1);
  };
  return worstFinger(setting, reference, error, &Sum::rms);
}

std::optional<double> frictionError(const Evidence& setting, const Evidence& reference) {
  const auto error = [](const FingerSample& a, const FingerSample& b) -> Value {
    if (!(a.touching > 0 && b.slipping > 0 && b.traction > 0)) return std::nullopt;
    return 100 * std::abs(a.traction / b.traction - 1);
  };
  return worstFinger(setting, reference, error, &Sum::rms);
}

std::optional<double> textureError(const Evidence& setting, const Evidence& reference) {
  Value worst;
  if (setting.trace.fingers != reference.trace.fingers) return worst;
  for (std::size_t f = 0; f < setting.trace.fingers; ++f) {
    const Value a = vibration(setting, f), b = vibration(reference, f);
    if (a && b) worst = std::max(worst.value_or(0), std::abs(*a - *b));
  }
  return worst;
}

}  // namespace presa::cost
