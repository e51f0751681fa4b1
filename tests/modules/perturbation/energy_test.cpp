// A finger that climbs a flank off the face, comes down on the crest and slides down within: the printed formula pays
// for it each time.
#include <gtest/gtest.h>

#include <vector>

#include "tests/modules/perturbation/perturbation_fixture.h"

namespace presa {
namespace {

using test::kAmplitude, test::kHigh, test::kPlace, test::kStiffness, test::kTurn, test::kWavelength, test::OnSide,
    test::perturbedCube;

constexpr double kCrest = kWavelength / 4, kHollow = 3 * kWavelength / 4;
constexpr double kDeep = 0.002;

/// Work of the force on the finger round the flank, by the trapezoidal rule with `steps` on each way.
double workRound(const World& world, double gain, int steps) {
  OnSide finger(world, 2);
  const Vec3 off(0, 0, -1e-4);
  const std::vector<Vec3> corners{Vec3(kHollow, 0, 0) + off,
                                  Vec3(kCrest, 0, 0) + off,
                                  {kCrest, 0, gain * kDeep},
                                  {kHollow, 0, gain * kDeep},
                                  Vec3(kHollow, 0, 0) + off};
  double work = 0;
  Vec3 last_p = corners[0], last_f = finger.force(last_p.x(), last_p.y(), last_p.z());
  for (std::size_t c = 1; c < corners.size(); ++c) {
    for (int i = 1; i <= steps; ++i) {
      const Vec3 p = corners[c - 1] + static_cast<double>(i) / steps * (corners[c] - corners[c - 1]);
      const Vec3 f = finger.force(p.x(), p.y(), p.z()), way = p - last_p;
      work += 0.5 * (f + last_f).dot(Vec3(way.x(), way.y(), -way.z()));  // the depth grows against z
      last_p = p;
      last_f = f;
    }
  }
  return work;
}

// k K H^2 / 2: the area of d < K h in the plane of height and depth. The others are 0: their forces have an energy.
// Tolerances: the place of the proxy over three ways of 2 K mm; the trapezoidal rule at step^2 / 12 times the change of
// the force's slope, which is below 10 k on each of four ways.
TEST(ALoopRoundAFlank, GainsWhatThePrintedFormulaLacksAndNothingElse) {
  constexpr int kSteps = 2000;
  for (const double gain : {1.0, 2.0}) {
    const double way = gain * kDeep, step = way / kSteps;
    const double tolerance = 3 * way * kStiffness * kPlace + 4 * step * step / 12 * 10 * kStiffness;
    const double lacks = kStiffness * gain * kHigh * kHigh / 2;
    EXPECT_LT(tolerance, 0.002 * lacks);
    const double printed = workRound(perturbedCube("printed", gain), gain, kSteps);
    const double conservative = workRound(perturbedCube("conservative", gain), gain, kSteps);
    EXPECT_NEAR(printed, lacks, tolerance) << gain;
    EXPECT_NEAR(conservative, 0, tolerance) << gain;
    RecordProperty("printed_uJ", std::to_string(1e6 * printed));
    RecordProperty("conservative_uJ", std::to_string(1e6 * conservative));
    const World texture = test::texturedCube({.shape = "sine", .amplitude = kAmplitude, .wavelength = kWavelength});
    EXPECT_NEAR(workRound(texture, gain, kSteps), 0, tolerance) << gain;
  }
}

// Strokes over many hills, deep and shallow, of every pattern.
TEST(ALoopOverManyHills, GainsNoEnergy) {
  for (const std::string shape : {"sine", "grid", "noise"}) {
    double error[2];
    for (const int per_wave : {25, 50}) {
      OnSide finger(perturbedCube("conservative", 1.5, shape, 1e-4), 4);
      const int steps = per_wave * 12;  // a loop of 24 mm
      double net = 0, moved = 0;
      Vec3 last_p, last_f;
      for (int i = 0; i <= steps; ++i) {
        const double angle = kTurn * i / steps;
        const Vec3 p(0.004 * std::cos(angle), 0.004 * std::sin(angle), 0.0005 + 0.0007 * std::sin(angle + 0.3));
        const Vec3 f = finger.force(p.x(), p.y(), p.z());
        if (i > 0) {
          const Vec3 way = p - last_p;
          const double work = 0.5 * (f + last_f).dot(Vec3(way.x(), way.y(), -way.z()));
          net += work;
          moved += std::abs(work);
        }
        last_p = p;
        last_f = f;
      }
      // the trapezoidal rule, as for textures: step^2 / 12 times (2 pi / wavelength)^2
      error[per_wave / 50] = std::abs(net) / moved;
      EXPECT_LT(error[per_wave / 50], std::pow(kTurn / per_wave, 2) / 12) << shape << ' ' << per_wave;
    }
    EXPECT_LT(error[1], std::max(error[0] / 2, 3e-4)) << shape;
  }
}

}  // namespace
}  // namespace presa
