// What a fingertip judges of a surface. Texture: the force that a device holds is constant from tick to tick, so that a
// first-order high-pass and a first-order low-pass of it have closed forms, at any haptic rate:
//   s' = (u - s) / a,  y' = (u - s - y) / b,  a = 1 / (2 pi 40 Hz),  b = 1 / (2 pi 400 Hz)
//   y(t) = y(0) exp(-t/b) + (u - s(0)) (exp(-t/a) - exp(-t/b)) a / (a - b)
#include "apps/studies/cost/felt_metrics.h"

#include <algorithm>
#include <array>
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

/// How much of the band's two states is left after a force was held for `seconds`, found anew where that changes.
struct Decay {
  double seconds = -1, slow = 0, fast = 0;
  void after(double held) {
    if (held == seconds) return;
    seconds = held;
    slow = std::exp(-held / kSlow);
    fast = std::exp(-held / kFast);
  }
};

}  // namespace

std::vector<double> vibrationOf(const Evidence& e) {
  const Trace& trace = e.trace;
  std::vector<std::array<Band, 3>> bands(trace.fingers);
  std::vector<double> squares(trace.fingers, 0);
  double time = 0;
  Decay decay;
  for (std::size_t i = 0; i + 1 < trace.held_from_ns.size(); ++i) {
    const double begin = 1e-9 * static_cast<double>(trace.held_from_ns[i]);
    const double held = 1e-9 * static_cast<double>(trace.held_from_ns[i + 1] - trace.held_from_ns[i]);
    const int samples = std::max(1, static_cast<int>(std::ceil(held / kSample - 1e-9)));
    const double step = held / samples;
    decay.after(step);
    const bool counts = begin >= e.compared_from && begin < e.compared_to;
    for (int k = 0; k < samples; ++k) {
      time += counts ? step : 0;
      for (std::size_t f = 0; f < trace.fingers; ++f) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          Band& band = bands[f][axis];
          band.hold(static_cast<double>(trace.held[i * trace.fingers + f][axis]), decay.slow, decay.fast);
          if (counts) squares[f] += band.out * band.out * step;
        }
      }
    }
  }
  if (time == 0) return {};
  for (double& each : squares) each = std::sqrt(each / time);
  return squares;
}

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
  if (setting.vibration.size() != reference.vibration.size()) return worst;
  for (std::size_t f = 0; f < setting.vibration.size(); ++f)
    worst = std::max(worst.value_or(0), std::abs(setting.vibration[f] - reference.vibration[f]));
  return worst;
}

std::optional<double> textureNoticeable(const Evidence& reference) {
  double most = 0;
  for (const double each : reference.vibration) most = std::max(most, each);
  return most >= kFaintVibration ? Value(kVibrationStep * most) : std::nullopt;
}

}  // namespace presa::cost
