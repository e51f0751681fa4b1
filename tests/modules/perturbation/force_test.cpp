// The printed formula, and the gradient of the conservative form's energy.
#include <gtest/gtest.h>

#include "framework/core/math/random.h"
#include "tests/modules/perturbation/perturbation_fixture.h"
#include "tests/support/alloc_lock_guard.h"

namespace presa {
namespace {

using test::heightAt, test::kAmplitude, test::kHigh, test::kPlace, test::kStiffness, test::kTurn, test::kWavelength,
    test::OnSide, test::perturbedCube, test::slopeAt;

/// What the proxy's place leaves open in a force: depth, height and slope of the printed form.
double tolerance(double gain) {
  const double curvature = kAmplitude * std::pow(kTurn / kWavelength, 2);
  return 2 * kStiffness * kPlace * (1 + gain * (1 + kHigh * curvature));
}

TEST(PrintedPerturbation, IsTheFormula) {
  RandomStream random(3, "places");
  for (const double gain : {1.0, 3.0}) {
    OnSide finger(perturbedCube("printed", gain), 1);
    int near_face = 0;
    for (int i = 0; i < 500; ++i) {
      const double x = 0.02 * (random.uniform() - 0.5), d = 0.002 * random.uniform();
      const double h = heightAt(x);
      const Vec3 N = Vec3::UnitZ(), gradient(slopeAt(x), 0, 0);
      const Vec3 M = N - gradient + gradient.dot(N) * N;
      const Vec3 F = d > gain * h ? Vec3((d - gain * h) * N + gain * h * M) : Vec3(d * M);
      near_face += d > gain * h ? 0 : 1;
      EXPECT_NEAR((finger.force(x, 0.003, d) - kStiffness * F).norm(), 0, tolerance(gain)) << x << ' ' << d;
    }
    EXPECT_GT(near_face, 30);
    EXPECT_LT(near_face, 450);
  }
}

/// Energy of the conservative form at a place x and depth d, from the README [J].
double energyAt(double x, double d, double gain) {
  const double u = std::min(1.0, d / (2 * gain * kHigh));
  return 0.5 * kStiffness * (d * d + gain * std::pow(heightAt(x), 2) * (3 * u * u - 2 * u * u * u));
}

TEST(Perturbation, IsTheNegativeGradientOfItsEnergy) {
  RandomStream random(4, "places");
  constexpr double kStep = 1e-6;
  for (const double gain : {1.0, 2.5}) {
    OnSide finger(perturbedCube("conservative", gain), 1);
    for (int i = 0; i < 500; ++i) {
      const double x = 0.02 * (random.uniform() - 0.5), d = 1e-5 + 0.003 * random.uniform();
      const Vec3 f = finger.force(x, 0.003, d);
      // central differences err by kStep^2 / 6 times third derivatives: at most k K h^2 12 / D^3, k K h^2 (2 pi / L)^3,
      // 1e-6 N; the second one jumps at D by k K h^2 6 / D^2 = k 3 / (2 K), which a step of 1e-6 m sees as 4e-4 N
      const double jump = std::abs(d - 2 * gain * kHigh) < 2 * kStep ? 4e-4 : 0;
      const double more = tolerance(gain) + 2e-6 + jump;
      EXPECT_NEAR(f.x(), -(energyAt(x + kStep, d, gain) - energyAt(x - kStep, d, gain)) / (2 * kStep), more) << x;
      EXPECT_NEAR(f.z(), (energyAt(x, d + kStep, gain) - energyAt(x, d - kStep, gain)) / (2 * kStep), more) << d;
      EXPECT_NEAR(f.y(), 0, more);
    }
  }
}

// From the depth D = 4 K amplitude on both forms are one, with the normal force of a plain face.
TEST(Perturbation, IsThePrintedFormulaDeepBelowTheFace) {
  for (const std::string shape : {"sine", "grid", "noise"}) {
    OnSide mine(perturbedCube("conservative", 2, shape, 1e-4), 3), printed(perturbedCube("printed", 2, shape, 1e-4), 3);
    double leans = 0;
    for (int i = 0; i < 300; ++i) {
      const double x = 0.01 * std::sin(i), y = 0.01 * std::sin(1.7 * i), d = 8.1e-4 + 1e-5 * (i % 100);
      const Vec3 f = mine.force(x, y, d);
      EXPECT_NEAR((f - printed.force(x, y, d)).norm(), 0, tolerance(2)) << shape;
      EXPECT_NEAR(f.z(), kStiffness * d, tolerance(2)) << shape;
      leans = std::max(leans, std::hypot(f.x(), f.y()));
    }
    EXPECT_GT(leans, 0.02) << shape;  // k K h times slope: up to 0.06 N on noise, 0.08 N on the others
  }
}

// The normal force begins at zero and grows with the depth by at least k / 4, also where a crest is.
TEST(Perturbation, NeverFallsWithTheDepth) {
  OnSide finger(perturbedCube("conservative", 1), 0);
  for (int place = 0; place < 8; ++place) {
    const double x = place * kWavelength / 8;
    EXPECT_LT(finger.force(x, 0, 1e-7).norm(), kStiffness * 3e-7);  // k (1 + 3/4), and the slope, which is 0.63
    double last = 0;
    for (int i = 1; i <= 300; ++i) {
      const double normal = finger.force(x, 0, 1e-5 * i).z();
      EXPECT_GT(normal - last, (0.25 * 1e-5 - 2 * kPlace) * kStiffness) << place << ' ' << i;
      EXPECT_LT(normal - last, (1.75 * 1e-5 + 4 * kPlace) * kStiffness) << place << ' ' << i;
      last = normal;
    }
  }
}

TEST(Perturbation, NeitherAllocatesNorLocks) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  for (const std::string form : {"conservative", "printed"}) {
    OnSide finger(perturbedCube(form, 1), 1);
    finger.force(0, 0, 0.001);
    const RealTimeGuard guard;
    for (int i = 0; i < 100; ++i) finger.force(1e-4 * i, 0, 1e-5 * i);
    EXPECT_EQ(guard.violations(), 0) << form << ' ' << guard.first();
  }
}

}  // namespace
}  // namespace presa
