#include <algorithm>
#include <cmath>
#include <cstdio>

#include "devices/percro_arm/bench.h"
#include "devices/percro_arm/characterise.h"
#include "devices/percro_arm/reach.h"
#include "devices/percro_arm/steps.h"

namespace presa::percro {
namespace {

using Basis = Characteristic::Basis;
using Figures = std::vector<Characteristic>;

/// A figure with one published number.
Characteristic printedAs(const std::string& name, const std::string& unit, double printed, double here,
                         double tolerance, Basis basis, const std::string& note) {
  return {name, unit, printed, printed, here, tolerance, basis, note};
}

/// A dimensionless figure with a lower bound, based on assumptions.
Characteristic atLeast(const std::string& name, double min, double here, const std::string& note) {
  return {name, "1", min, std::numeric_limits<double>::infinity(), here, 0, Basis::kAssumed, note};
}

Characteristic unprinted(const std::string& name, const std::string& unit, double here, Basis basis,
                         const std::string& note) {
  return {.name = name, .unit = unit, .here = here, .basis = basis, .note = note};
}

void addResolution(const Parameters& p, Figures& out) {
  const Geometry& g = p.geometry;
  const std::string note =
      "2.2; both encoders of the differential step at once. The ratio 55:130 differs from 441:1070";
  out.push_back(printedAs("position step across, L = 441 mm", "um", printed::kStepShort * 1e6,
                          measuredStep(p, g.length_min) * 1e6, 0.02, Basis::kFitted, note));
  out.push_back(printedAs("position step across, L = 1070 mm", "um", printed::kStepLong * 1e6,
                          measuredStep(p, g.length_max) * 1e6, 0.02, Basis::kFitted, note));
  out.push_back(unprinted("position step along the barrel", "um", axialStep(p) * 1e6, Basis::kFollows,
                          "from the drum radius with the best conditioning"));
}

void addWorkspace(const Parameters& p, Figures& out) {
  const Geometry& g = p.geometry;
  const Vec3 deep{printed::kBoxDepth, printed::kBoxHeight, printed::kBoxWidth};
  const Vec3 wide{printed::kBoxHeight, printed::kBoxWidth, printed::kBoxDepth};
  out.push_back(printedAs("box of 300 x 400 mm: its depth along the barrel", "mm", printed::kBoxDepth * 1e3,
                          largestScale(g, deep) * printed::kBoxDepth * 1e3, 0.002, Basis::kFollows,
                          "2.1.1; from L = 441 to 1070 mm, printed to 1 mm"));
  out.push_back(atLeast("box of 300 x 400 x 600 mm, 600 across: scale that fits", 1, largestScale(g, wide),
                        "2.1.1; with tilt to 45 and yaw to 40 degrees"));
  out.push_back(
      atLeast("the same in the reach of both arms, 1.5 m apart", 1, largestCommonScale(g, wide, kArmsApart), "fig. 3"));
  double worst = 0;
  for (const double x : steps(g.length_min, g.length_max, 60)) {
    for (const double y : steps(0, 0.15, 15)) {
      for (const double z : steps(0, 0.2, 20)) {
        const Joints q = jointsAt(g, {x, y, z});
        if (withinReach(g, q, 1e-9)) worst = std::max(worst, conditionNumber(g, q));
      }
    }
  }
  out.push_back(unprinted("condition number of J K^-1, worst in that box", "1", worst, Basis::kFollows,
                          "2.1: \"optimal\", fig. 2; the best for any drum between L = 441 and 1070 mm"));
}

void addForces(const Parameters& p, Figures& out) {
  const ReachBox box{{largestScale(p.geometry, {0.6, 0.3, 0.4}) * 0.6, 0.3, 0.4}, p.geometry.length_min};
  out.push_back(printedAs("continuous force, worst place and direction", "N", printed::kContinuousForce,
                          minForce(p, box, p.motors.continuous_torque), 0.02, Basis::kFitted,
                          "2.1; over the box, while carrying the arm"));
  out.push_back(printedAs("peak force, worst place and direction", "N", printed::kPeakForce,
                          minForce(p, box, p.motors.peak_torque), 0.02, Basis::kFitted, "2.1"));
  const double ratio = p.motors.peak_torque / p.motors.continuous_torque;
  out.push_back(unprinted("peak force lasts, from cold", "s",
                          -p.motors.thermal_time * std::log(1 - 0.9 / (ratio * ratio)), Basis::kAssumed,
                          "with a winding of 30 s"));
}

void addStructure(const Parameters& p, Figures& out) {
  const Push along = push(p, 0.75, Vec3::UnitX(), printed::kPeakForce);
  out.push_back(printedAs("stiffness along the barrel", "N/mm", 23.74, along.stiffness * 1e-3, 0.03, Basis::kFitted,
                          "2.1.2; pushed to 10 N, displacement by the encoder"));
  out.push_back(printedAs("R^2 of that line", "1", 0.994, along.r_squared, 0.02, Basis::kFollows,
                          "2.1.2; 10 N give 420 um, seven steps of the encoder"));
  out.push_back(printedAs("stiffness across, L = 1070 mm", "N/mm", printed::kStiffLong * 1e-3,
                          push(p, p.geometry.length_max - 1e-3, Vec3::UnitY(), 4).stiffness * 1e-3, 0.05,
                          Basis::kFitted, "2.1.2, fig. 6"));
  out.push_back(printedAs("stiffness across, L = 441 mm", "N/mm", printed::kStiffShort * 1e-3,
                          push(p, p.geometry.length_min + 1e-3, Vec3::UnitY(), 4).stiffness * 1e-3, 0.05,
                          Basis::kFitted, "2.1.2, fig. 6; 4 N give 300 um, five steps of the encoders"));
}

void addDynamics(const Parameters& p, Figures& out) {
  const ForceResponse response = forceResponse(p, steps(2, 120, 59));
  out.push_back({"force bandwidth along the barrel (-3 dB)", "Hz", printed::kBandwidthLow, printed::kBandwidthHigh,
                 response.bandwidth, 0, Basis::kFitted, "2.1.2, fig. 5; the moving mass is fitted to it"});
  out.push_back(unprinted("resonance on the way", "Hz", response.resonance, Basis::kAssumed,
                          "damping 0.1 of critical; not stated in the paper"));
  const ArmDynamics arm(p, Vec3::Zero());
  const Joints in = Joints::Zero(), drawn_out{0, 0, p.geometry.length_max - p.geometry.length_min};
  const double low = p.geometry.length_min, high = p.geometry.length_max;
  const double mass = arm.inertia(drawn_out)[1] / (high * high);
  out.push_back(unprinted("mass felt along the barrel", "kg", arm.inertia(in)[2], Basis::kFitted, "by the bandwidth"));
  out.push_back(unprinted("mass felt across, L = 441 mm", "kg", arm.inertia(in)[1] / (low * low), Basis::kAssumed, ""));
  out.push_back(unprinted("mass felt across, L = 1070 mm", "kg", mass, Basis::kAssumed, ""));
  out.push_back(unprinted("first mode across, L = 1070 mm, tip bolted", "Hz",
                          std::sqrt(printed::kStiffLong / mass) / (2 * std::numbers::pi), Basis::kAssumed,
                          "the paper shows the dynamics along the barrel only"));
}

}  // namespace

double measuredStep(const Parameters& p, double length) {
  // turn the motors against each other in hundredths of a count and take the max jump of the reported position
  Encoders encoders(p);
  const Mat3 to_joints = transmissionInverse(p.geometry);
  const Joints middle = {0, 0, length - p.geometry.length_min};
  double max = 0;
  Vec3 before = Vec3::Zero();
  for (int i = 0; i <= 300; ++i) {
    const double turn = 0.01 * i * p.motors.count();
    encoders.sample(middle + to_joints * Vec3(-turn, turn, 0));
    const Vec3 now = tipPosition(p.geometry, encoders.joints());
    if (i > 0) max = std::max(max, (now - before).norm());
    before = now;
  }
  return max;
}

std::vector<Characteristic> figures(const Parameters& parameters) {
  Figures out;
  addResolution(parameters, out);
  addWorkspace(parameters, out);
  addForces(parameters, out);
  addStructure(parameters, out);
  addDynamics(parameters, out);
  return out;
}

}  // namespace presa::percro
