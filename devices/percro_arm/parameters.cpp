#include "devices/percro_arm/parameters.h"

#include <cmath>

namespace presa::percro {
namespace {

/// A rotation of both motors by one count, in any direction, moves the tip by L * count / tau_1. The published 55 and
/// 130 um cannot both be met exactly (130/55 = 2.36, 1070/441 = 2.43): the mean of the two resulting ratios leaves an
/// error of 1.3 % at both.
double tiltRatio(const Geometry& g, double count) {
  return 0.5 * count * (g.length_min / printed::kStepShort + g.length_max / printed::kStepLong);
}

/// J K^-1 has the singular values L cos(q2) / (sqrt 2 tau_1), L / (sqrt 2 tau_1), r_b. Its worst condition number over
/// the workspace is minimal when r_b is the geometric mean of the extremes of the others.
double drumRadius(const Geometry& g) {
  return std::sqrt(g.length_min * g.length_max) / (std::numbers::sqrt2 * g.tilt_ratio);
}

/// Motor torque for a force across the fully extended barrel, in the direction that loads one motor most.
double worstTorque(const Geometry& g, double force) {
  return force * g.length_max / (std::numbers::sqrt2 * g.tilt_ratio);
}

/// Moving mass along the barrel of a mass on a spring with damping ratio zeta whose force response has -3 dB at
/// `frequency`: f = f_n sqrt(1 - 2 z^2 + sqrt((1 - 2 z^2)^2 + 1)).
double movingMass(double stiffness, double zeta, double frequency) {
  const double a = 1 - 2 * zeta * zeta;
  const double natural = 2 * std::numbers::pi * frequency / std::sqrt(a + std::sqrt(a * a + 1));
  return stiffness / (natural * natural);
}

/// Fits a1 and a3 to the stiffness at both ends: a1 + a3 L^2 = c / L.
void bend(const Geometry& g, Structure& s) {
  const double low = 1 / (printed::kStiffShort * g.length_min), high = 1 / (printed::kStiffLong * g.length_max);
  s.bend_cubic = (high - low) / (g.length_max * g.length_max - g.length_min * g.length_min);
  s.bend_linear = low - s.bend_cubic * g.length_min * g.length_min;
}

}  // namespace

Parameters paperArm() {
  constexpr double kZeta = 0.1;
  Parameters p;
  p.geometry.tilt_ratio = tiltRatio(p.geometry, p.motors.count());
  p.geometry.drum_radius = drumRadius(p.geometry);
  p.motors.continuous_torque = worstTorque(p.geometry, printed::kContinuousForce);
  p.motors.peak_torque = worstTorque(p.geometry, printed::kPeakForce);
  bend(p.geometry, p.structure);
  const double middle = 0.5 * (printed::kBandwidthLow + printed::kBandwidthHigh);
  const double moving = movingMass(p.structure.axial_stiffness, kZeta, middle);
  p.structure.damping_time = 2 * kZeta * std::sqrt(moving / p.structure.axial_stiffness);
  Masses& m = p.masses;
  m.barrel = moving - p.motors.rotor_inertia / (p.geometry.drum_radius * p.geometry.drum_radius);
  m.counterweight_arm = m.barrel * (p.geometry.length_max - m.barrel_setback) / m.counterweight;
  return p;
}

}  // namespace presa::percro
