#include "devices/percro_arm/dynamics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "framework/core/math/random.h"
#include "tests/devices/percro_arm/arm.h"

namespace presa::percro {
namespace {

Parameters lossless() {
  Parameters p = paperArm();
  p.friction = {{0, 0, 0}, {0, 0, 0}};
  p.structure.damping_time = 0;
  return p;
}

/// A state that swings by about 10 cm with vibrations of the structure.
ArmState released(const ArmDynamics& arm) {
  ArmState state = arm.atRest({0.75, 0.05, -0.08});
  state.x += Vec3(1e-3, -2e-3, 1e-3);
  state.v = {0.3, -0.2, 0.4};
  state.p = {0.02, -0.03, 0.05};
  return state;
}

TipLoad springHand() { return {.mass = 0.1, .stiffness = 300, .target = {0.8, 0, 0}}; }

ArmState after(const ArmDynamics& arm, const TipLoad& load, double time, double h) {
  ArmState state = released(arm);
  const int steps = static_cast<int>(std::lround(time / h));
  for (int i = 0; i < steps; ++i) arm.step(state, Vec3::Zero(), load, h);
  return state;
}

double distance(const ArmState& a, const ArmState& b) {
  return std::max({(a.q - b.q).norm(), (a.x - b.x).norm(), (a.v - b.v).norm(), (a.p - b.p).norm()});
}

// Reference: the kinetic energy of point masses attached to the barrel frame, with speeds by central differences. Rods
// of point masses replace barrel and counterweight; parts that rotate with one joint only are added separately.
// Tolerance 1e-6: the step of the differences.
TEST(PercroDynamics, InertiaIsTheKineticEnergyOfItsParts) {
  const Parameters p = paperArm();
  const ArmDynamics arm(p, kGravity);
  RandomStream stream(1, "inertia");
  const double reach =
      std::sqrt(p.masses.barrel_inertia / p.masses.barrel - p.masses.roll_inertia / (2 * p.masses.barrel));
  const double radius = std::sqrt(p.masses.roll_inertia / p.masses.barrel);
  const auto barrel = [&](const Joints& q) {  // two ends along the barrel, four points around it: equal moments
    std::vector<Vec3> points;
    const double centre = p.geometry.length_min + q[2] - p.masses.barrel_setback;
    for (const double along : {-reach, reach}) {
      for (const Vec3& around : {Vec3(0, radius, 0), Vec3(0, -radius, 0), Vec3(0, 0, radius), Vec3(0, 0, -radius)})
        points.push_back(barrelFrame(q) * (Vec3(centre + along, 0, 0) + around));
    }
    return points;
  };
  const auto weight = [&](const Joints& q) -> Vec3 { return barrelFrame(q).col(0) * -p.masses.counterweight_arm; };
  for (int i = 0; i < 50; ++i) {
    const Joints q{stream.uniform(-0.7, 0.7), stream.uniform(-0.6, 0.6), stream.uniform(0, 0.6)};
    const Vec3 rate{stream.uniform(-1, 1), stream.uniform(-1, 1), stream.uniform(-1, 1)};
    const double h = 1e-5;
    const auto ahead = barrel(q + h * rate), behind = barrel(q - h * rate);
    double energy =
        0.5 * p.masses.counterweight * ((weight(q + h * rate) - weight(q - h * rate)) / (2 * h)).squaredNorm();
    for (std::size_t k = 0; k < ahead.size(); ++k)
      energy += 0.5 * p.masses.barrel / 8 * ((ahead[k] - behind[k]) / (2 * h)).squaredNorm();
    const Vec3 rotors = transmission(p.geometry) * rate;
    energy += 0.5 * (p.masses.tilt_inertia * rate[0] * rate[0] + p.masses.yaw_inertia * rate[1] * rate[1] +
                     p.motors.rotor_inertia * rotors.squaredNorm());
    EXPECT_NEAR(0.5 * rate.dot(arm.inertia(q).cwiseProduct(rate)), energy, 1e-6 * energy);
  }
}

// Hamilton's equations by finite differences of the energy: q' = dH/dp, p' = -dH/dq, x' = v, m v' = -dH/dx.
TEST(PercroDynamics, MovesAsTheGradientOfItsEnergySays) {
  const ArmDynamics arm(lossless(), kGravity);
  RandomStream stream(2, "gradient");
  const TipLoad load = springHand();
  for (int i = 0; i < 20; ++i) {
    ArmState state = arm.atRest({stream.uniform(0.5, 1), stream.uniform(-0.3, 0.3), stream.uniform(-0.3, 0.3)});
    for (int k = 0; k < 3; ++k) {
      state.p[k] = stream.uniform(-0.2, 0.2), state.v[k] = stream.uniform(-1, 1);
      state.x[k] += stream.uniform(-2e-3, 2e-3);
    }
    ArmState next = state;
    const double h = 1e-7, d = 1e-6;
    arm.step(next, Vec3::Zero(), load, h);
    const auto slope = [&](Vec3 ArmState::*part, int k) {
      ArmState up = state, down = state;
      (up.*part)[k] += d, (down.*part)[k] -= d;
      return (arm.energy(up, load) - arm.energy(down, load)) / (2 * d);
    };
    for (int k = 0; k < 3; ++k) {
      // h / 2 times the second derivatives, up to 1e6 for the barrel's springs, plus rounding 1e-9 / h
      EXPECT_NEAR((next.q[k] - state.q[k]) / h, slope(&ArmState::p, k), 1e-4);
      EXPECT_NEAR((next.p[k] - state.p[k]) / h, -slope(&ArmState::q, k), 1e-2);
      EXPECT_NEAR((next.v[k] - state.v[k]) / h * load.mass, -slope(&ArmState::x, k), 1e-2);
    }
  }
}

// Second order: half the step gives a quarter of the energy ripple. No drift: the means of the first and the last
// second agree within a tenth of the ripple.
TEST(PercroDynamics, KeepsItsEnergyToSecondOrder) {
  const ArmDynamics arm(lossless(), kGravity);
  const TipLoad load = springHand();
  const auto ripple = [&](double h) {
    ArmState state = released(arm);
    const double start = arm.energy(state, load);
    const int quarter = static_cast<int>(std::lround(1 / h)), steps = 4 * quarter;
    double max = 0, first = 0, last = 0;
    for (int i = 0; i < steps; ++i) {
      arm.step(state, Vec3::Zero(), load, h);
      const double off = arm.energy(state, load) - start;
      max = std::max(max, std::abs(off));
      if (i < quarter) first += off;
      if (i >= 3 * quarter) last += off;
    }
    EXPECT_LT(std::abs(last - first) / quarter, 0.1 * max) << h;
    return max;
  };
  const double coarse = ripple(0.5e-3), fine = ripple(0.25e-3);
  EXPECT_GT(coarse / fine, 3.5);
  EXPECT_LT(coarse / fine, 4.5);
  EXPECT_LT(fine, 1e-3 * 0.5 * 0.1 * 0.29);  // relative to the tip's initial kinetic energy
}

// Reference: a step 32 times finer than the finest.
TEST(PercroDynamics, ConvergesWithTheSquareOfTheStep) {
  for (const bool losses : {false, true}) {
    Parameters p = paperArm();
    p.friction = {{0, 0, 0}, {0.02, 0.02, 0.5}};
    const ArmDynamics arm(losses ? p : lossless(), kGravity);
    TipLoad load = springHand();
    load.damping = losses ? 5 : 0;
    const ArmState reference = after(arm, load, 0.1, 1e-3 / 512);
    double before = 0;
    for (const double h : {1e-3 / 4, 1e-3 / 8, 1e-3 / 16}) {
      const double error = distance(after(arm, load, 0.1, h), reference);
      if (before > 0) {
        EXPECT_GT(before / error, 3.7);
        EXPECT_LT(before / error, 4.3);
      }
      before = error;
    }
  }
}

// The structure vibrates at 90 Hz; steps of up to nearly two such periods, twenty haptic ticks, are stable.
TEST(PercroDynamics, NoStepIsUnstable) {
  const Parameters p = paperArm();
  const ArmDynamics arm(p, kGravity);
  for (const double h : {1e-4, 1e-3, 5e-3, 2e-2}) {
    ArmState state = released(arm);
    const TipLoad load = springHand();
    const double start = arm.energy(state, load);
    for (int i = 0; i < 4000; ++i) {
      arm.step(state, Vec3::Zero(), load, h);
      ASSERT_TRUE(state.q.allFinite() && state.v.allFinite()) << h;
      ASSERT_LT(arm.energy(state, load), start + 0.1) << h;  // [J] of 1.6
    }
  }
}

// With friction the energy decreases in every step, up to the ripple of the method, and the arm comes to rest.
TEST(PercroDynamics, FrictionTakesEnergyAway) {
  const ArmDynamics arm(paperArm(), Vec3::Zero());
  TipLoad load = springHand();
  load.damping = 3;
  ArmState state = released(arm);
  const double start = arm.energy(state, load);
  double before = start;
  for (int i = 0; i < 20'000; ++i) {
    arm.step(state, Vec3::Zero(), load, 0.25e-3);
    const double now = arm.energy(state, load);
    ASSERT_LT(now - before, 1e-7 * start) << i;
    before = now;
  }
  EXPECT_EQ(state.p, Vec3::Zero());
  EXPECT_LT(state.v.norm(), 1e-9);
  EXPECT_LT(before, 0.5 * start);
}

// Dry friction: below it a joint does not creep by a single bit; above it the joint moves.
TEST(PercroDynamics, AStuckJointDoesNotCreep) {
  const Parameters p = paperArm();
  const ArmDynamics arm(p, Vec3::Zero());
  const TipLoad hand{.mass = 0.1};
  for (int joint = 0; joint < 3; ++joint) {
    const ArmState start = arm.atRest({0.75, 0, 0});
    ArmState below = start, above = start;
    for (int i = 0; i < 4000; ++i) {
      arm.step(below, 0.999 * p.friction.coulomb[joint] * Vec3::Unit(joint), hand, 0.25e-3);
      arm.step(above, 1.001 * p.friction.coulomb[joint] * Vec3::Unit(joint), hand, 0.25e-3);
    }
    EXPECT_EQ(below.q, start.q);
    EXPECT_GT(above.q[joint] - start.q[joint], 1e-5);
  }
}

// Statics: with the joints held by the motors, a force on the tip displaces it by the compliance of eq. 4, or of K_x.
TEST(PercroDynamics, TipYieldsByThePrintedCompliance) {
  Parameters p = paperArm();
  p.friction.coulomb[0] = p.friction.coulomb[1] = p.friction.coulomb[2] = 1e3;  // holds the joints
  const ArmDynamics arm(p, Vec3::Zero());
  for (const double length : {0.441, 0.75, 1.07}) {
    const ArmState start = arm.atRest({length, 0, 0});
    for (int axis = 0; axis < 3; ++axis) {
      ArmState state = start;
      const TipLoad load{.mass = 0.1, .damping = 30, .force = 2 * Vec3::Unit(axis)};
      for (int i = 0; i < 20'000; ++i) arm.step(state, Vec3::Zero(), load, 0.25e-3);
      const double compliance = axis == 0 ? 1 / 23.74e3 : p.structure.compliance(length);
      EXPECT_NEAR((state.x - start.x)[axis], 2 * compliance, 1e-5 * compliance + 1e-9);
      EXPECT_NEAR(arm.tipForce(state)[axis], -2, 1e-4);
    }
  }
}

TEST(PercroDynamics, TheCounterweightBalancesTheDrawnOutBarrel) {
  const ArmDynamics arm(paperArm(), kGravity);
  EXPECT_NEAR(arm.weight({0, 0, 1.070 - 0.441})[0], 0, 1e-12);
  EXPECT_LT(arm.weight({0, 0, 0})[0], -1);  // retracted, the counterweight lifts the tip
}

}  // namespace
}  // namespace presa::percro
