#include "devices/percro_arm/bench.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace presa::percro {
namespace {

constexpr double kBenchPeriod = 1e-3;
constexpr double kMean = 3, kAmplitude = 2;  // [N]
const TipLoad kBolted{.held = true};

/// Amplitude at the sensor for a commanded sine, in steady state, over full periods.
double amplitudeAt(const Parameters& parameters, double frequency) {
  SimulatedArm arm(parameters, Vec3::Zero(), kBenchPeriod);
  arm.place({0.75, 0, 0});
  const double turns = std::max(4.0, std::ceil(0.3 * frequency));
  const auto settle = static_cast<int>(std::lround(0.5 / kBenchPeriod));
  const auto ticks = static_cast<int>(std::lround(turns / frequency / kBenchPeriod));
  std::complex<double> sum = 0;
  for (int i = 0; i < settle + ticks; ++i) {
    const double angle = 2 * std::numbers::pi * frequency * i * kBenchPeriod;
    if (i >= settle) sum += arm.tipForce().x() * std::polar(1.0, -angle);
    arm.command({kMean + kAmplitude * std::sin(angle), 0, 0});
    arm.advance(kBolted);
  }
  return 2 * std::abs(sum) / ticks;
}

}  // namespace

ForceResponse forceResponse(const Parameters& parameters, const std::vector<double>& frequencies) {
  ForceResponse response;
  response.frequency = frequencies;
  response.peak_db = -std::numeric_limits<double>::infinity();
  for (const double frequency : frequencies) {
    const double gain = 20 * std::log10(amplitudeAt(parameters, frequency) / kAmplitude);
    response.gain_db.push_back(gain);
    if (gain > response.peak_db) response.peak_db = gain, response.resonance = frequency;
  }
  const double limit = response.gain_db.front() - 3;
  for (std::size_t i = 1; i < frequencies.size() && response.bandwidth == 0; ++i) {
    const double before = response.gain_db[i - 1], now = response.gain_db[i];
    if (now < limit)
      response.bandwidth =
          frequencies[i - 1] + (frequencies[i] - frequencies[i - 1]) * (before - limit) / (before - now);
  }
  return response;
}

double linearGain(const Parameters& p, double frequency) {
  const std::complex<double> s(0, 2 * std::numbers::pi * frequency);
  const double k = p.structure.axial_stiffness, mass = ArmDynamics(p, Vec3::Zero()).inertia(Joints::Zero())[2];
  const std::complex<double> spring = k * (1.0 + p.structure.damping_time * s);
  const std::complex<double> arm = spring / (spring + s * (mass * s + p.friction.viscous[2]));
  const std::complex<double> current = 1.0 / (1.0 + s / (2 * std::numbers::pi * p.motors.current_bandwidth));
  return 20 * std::log10(std::abs(arm * current));
}

Push push(const Parameters& parameters, double length, const Vec3& direction, double max_force) {
  constexpr int kLevels = 40;
  constexpr double kSettle = 1.0;  // [s] per level
  SimulatedArm arm(parameters, Vec3::Zero(), kBenchPeriod);
  arm.place({length, 0, 0});
  const Vec3 start = arm.reportedPosition();
  Push push;
  for (int level = 0; level <= kLevels; ++level) {
    const double part = 1 - std::abs(2.0 * level / kLevels - 1);
    for (int i = 0; i < kSettle / kBenchPeriod; ++i) {
      arm.command(part * max_force * direction);
      arm.advance(kBolted);
    }
    push.displacement.push_back((arm.reportedPosition() - start).dot(direction));
    push.force.push_back(arm.tipForce().dot(direction));
  }
  const auto count = static_cast<double>(push.force.size());
  double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  for (std::size_t i = 0; i < push.force.size(); ++i) x += push.displacement[i] / count, y += push.force[i] / count;
  for (std::size_t i = 0; i < push.force.size(); ++i) {
    const double dx = push.displacement[i] - x, dy = push.force[i] - y;
    xx += dx * dx, xy += dx * dy, yy += dy * dy;
  }
  push.stiffness = xy / xx;
  push.r_squared = xy * xy / (xx * yy);
  return push;
}

double wallShake(const Parameters& parameters, double length, const Vec3& direction, double stiffness,
                 double hand_damping) {
  constexpr double kLean = 3, kSettle = 3, kWatch = 1;  // [N], [s], [s]
  SimulatedArm arm(parameters, Vec3::Zero(), kBenchPeriod);
  arm.place({length, 0, 0});
  const Vec3 wall = arm.reportedPosition();
  const TipLoad hand{
      .mass = 0.1, .stiffness = 300, .damping = hand_damping, .target = wall, .force = kLean * direction};
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (int i = 0; i < (kSettle + kWatch) / kBenchPeriod; ++i) {
    const double depth = std::max(0.0, (arm.reportedPosition() - wall).dot(direction));
    arm.command(-std::min(stiffness * depth, printed::kPeakForce) * direction);
    arm.advance(hand);
    const double at = arm.state().x.dot(direction);
    if (i * kBenchPeriod >= kSettle) low = std::min(low, at), high = std::max(high, at);
  }
  return high - low;
}

}  // namespace presa::percro
