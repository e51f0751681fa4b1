// The force of a texture, against its formula, its spectrum, and the gradient of its energy.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "framework/core/math/random.h"
#include "tests/modules/texture/texture_fixture.h"
#include "tests/support/alloc_lock_guard.h"

namespace presa {
namespace {

using test::kStiffness, test::kTurn, test::OnSide, test::TextureValues;

/// Of the proxy, which ends within 1e-6 of the fingertip's radius.
constexpr double kPlace = 1e-6 * test::kR;

/// What a shift of the touched point by kPlace changes in a force at this depth: the second derivative of the height is
/// at most amplitude (2 pi / wavelength)^2 along each of two directions, of noise a third of that.
double forceTolerance(const TextureValues& texture, double depth) {
  const double shortest = texture.across > 0 ? std::min(texture.across, texture.wavelength) : texture.wavelength;
  return kStiffness * kPlace * (1 + 2 * depth * texture.amplitude * std::pow(kTurn / shortest, 2));
}

// A sine of 0.1 mm, 1 mm long, stroked at 80 mm/s at a depth of 2 mm for 80 of its periods: the normal force has the
// line k A at 80 Hz, and nothing else beside its mean k (d - A). Tolerances: those of the requirement; the rest is
// rounding.
TEST(SineTexture, ShowsItsFrequencyInTheForce) {
  constexpr int kTicks = 1000;
  constexpr double kSpeed = 0.08, kDepth = 0.002, kAmplitude = 1e-4;
  OnSide finger(test::texturedCube({.shape = "sine", .amplitude = kAmplitude, .wavelength = 1e-3}), 2);
  std::vector<double> normal, along;
  for (int i = 0; i < kTicks; ++i) {
    const Vec3 f = finger.force(-0.04 + kSpeed * 1e-3 * i, 0.003, kDepth);
    normal.push_back(f.z());
    along.push_back(f.x());
  }
  const auto line = [&](const std::vector<double>& force, int hertz) {
    std::complex<double> sum = 0;
    for (int i = 0; i < kTicks; ++i)
      sum += force[static_cast<std::size_t>(i)] * std::polar(1.0, -kTurn * hertz * i / kTicks);
    return (hertz == 0 ? 1 : 2) * std::abs(sum) / kTicks;
  };
  EXPECT_NEAR(line(normal, 0), kStiffness * (kDepth - kAmplitude), 0.02 * kStiffness * kAmplitude);
  EXPECT_NEAR(line(normal, 80), kStiffness * kAmplitude, 0.02 * kStiffness * kAmplitude);
  // along the stroke -k (d - A + A sin) A' cos: 80 Hz, and its double with A / (2 (d - A)) of it
  const double slope = kTurn * kAmplitude / 1e-3, first = kStiffness * (kDepth - kAmplitude) * slope;
  EXPECT_NEAR(line(along, 80), first, 0.02 * first);
  EXPECT_NEAR(line(along, 160), 0.5 * kStiffness * kAmplitude * slope, 0.02 * first);
  for (int hertz = 1; hertz < kTicks / 2; ++hertz) {
    if (hertz == 80) continue;
    EXPECT_LT(line(normal, hertz), 0.05 * kStiffness * kAmplitude) << hertz;
    EXPECT_LT(line(along, hertz), 0.05 * first) << hertz;
  }
}

// The formula of the README, turned by 30 degrees in the face.
TEST(GridTexture, IsTheSumOfTwoSinesAcrossEachOther) {
  const TextureValues grid{.shape = "grid", .amplitude = 1e-4, .wavelength = 2e-3, .direction = 30, .across = 3e-3};
  OnSide finger(test::texturedCube(grid), 2);
  const double a = std::numbers::pi / 6, depth = 0.0015;
  for (int i = 0; i < 200; ++i) {
    const double x = 0.01 * std::sin(i), y = 0.01 * std::sin(1.7 * i);
    const double u = (x * std::cos(a) + y * std::sin(a)) / 2e-3, v = (y * std::cos(a) - x * std::sin(a)) / 3e-3;
    const double h = 1e-4 * ((std::sin(kTurn * u) + std::sin(kTurn * v)) / 2 - 1);
    const double along = 1e-4 * kTurn / 2 * std::cos(kTurn * u) / 2e-3,
                 across = 1e-4 * kTurn / 2 * std::cos(kTurn * v) / 3e-3;
    const Vec3 expected =
        kStiffness * (depth + h) *
        Vec3(-along * std::cos(a) + across * std::sin(a), -along * std::sin(a) - across * std::cos(a), 1);
    EXPECT_NEAR((finger.force(x, y, depth) - expected).norm(), 0, forceTolerance(grid, depth)) << i;
  }
}

// The energy is read off the normal force, E = (f . nhat)^2 / (2 k), as for any spring. The force is its negative
// gradient.
TEST(Texture, GivesTheNegativeGradientOfItsEnergy) {
  for (const TextureValues& texture :
       {TextureValues{.shape = "sine", .direction = 20},
        TextureValues{.shape = "grid", .wavelength = 2e-3, .across = 1e-3},
        TextureValues{.shape = "noise", .wavelength = 1e-3, .direction = -50, .across = 3e-3}}) {
    OnSide finger(test::texturedCube(texture), 4);
    RandomStream random(7, "places");
    constexpr double kStep = 2e-6;
    for (int i = 0; i < 300; ++i) {
      const Vec3 at(0.02 * (random.uniform() - 0.5), 0.02 * (random.uniform() - 0.5),
                    0.0003 + 0.002 * random.uniform());
      const auto energy = [&](const Vec3& p) {
        const double normal = finger.force(p.x(), p.y(), p.z()).z();
        return 0.5 * normal * normal / kStiffness;
      };
      const Vec3 f = finger.force(at.x(), at.y(), at.z());
      for (int axis = 0; axis < 3; ++axis) {
        const Vec3 step = kStep * Vec3::Unit(axis);
        const double slope = (energy(at + step) - energy(at - step)) / (2 * kStep);
        // z of T points out of the face, the depth into it. Central differences err by kStep^2 / 6 times the third
        // derivative of the energy, k d A q^3 + 3 k A^2 q^3 with q = 2 pi / 1 mm: 5e-5 N
        EXPECT_NEAR(f[axis], axis == 2 ? slope : -slope, 1e-4) << texture.shape << ' ' << i << ' ' << axis;
      }
    }
  }
}

// The crests lie in the face: a finger at no depth feels nothing, wherever it comes.
TEST(Texture, BeginsWithoutAJumpOfTheForce) {
  for (const std::string shape : {"sine", "grid", "noise"}) {
    OnSide finger(test::texturedCube({.shape = shape, .wavelength = 2e-3}), 0);
    double deepest = 1, highest = 0;
    for (int i = 0; i < 2000; ++i) {
      const double x = 0.02 * std::sin(0.7 * i), y = 0.02 * std::sin(1.1 * i);
      EXPECT_LT(finger.force(x, y, 1e-6).norm(), kStiffness * 1.5e-6) << shape;  // slopes of 1 at most: below sqrt(2)
      const double height = finger.force(x, y, 0.001).z() / kStiffness - 0.001;
      deepest = std::min(deepest, height), highest = std::max(highest, height);
    }
    EXPECT_LE(highest, kPlace) << shape;
    EXPECT_GE(deepest, -2e-4 - kPlace) << shape;
    EXPECT_LT(deepest, -1.2e-4) << shape;  // and it is rough
  }
}

// Noise does not repeat, differs by seed, and is the same on every machine: three values from another program
// (noise_oracle.py 42 0.25 0.5 -12.3 7.7 21.4 -30.1, beside this file).
TEST(NoiseTexture, IsTheSameOnEveryMachine) {
  const TextureValues noise{.shape = "noise", .amplitude = 1e-4, .wavelength = 1e-3, .seed = 42};
  OnSide finger(test::texturedCube(noise), 2), other(test::texturedCube({.shape = "noise", .seed = 43}), 2);
  const double depth = 0.001;
  for (const auto& [x, y, s] : {std::tuple(0.00025, 0.0005, -0.354983299624),
                                {-0.0123, 0.0077, 0.302183451011},
                                {0.0214, -0.0301, -0.408793413598}}) {
    EXPECT_NEAR(finger.force(x, y, depth).z() / kStiffness - depth, 1e-4 * (s - 1), 2 * kPlace) << x;
    EXPECT_GT(std::abs(other.force(x, y, depth).z() - finger.force(x, y, depth).z()), 1e-3) << x;
  }
}

// On any side, box or mesh, and over the borders of its triangles, the texture is the same in the tangent frame.
TEST(Texture, IsTheSameOnEverySideAndOnCutFaces) {
  for (const TextureValues& texture : {TextureValues{.shape = "sine", .direction = 35},
                                       TextureValues{.shape = "noise", .wavelength = 2e-3, .across = 5e-3}}) {
    OnSide first(test::texturedCube(texture), 0);
    for (const bool mesh : {false, true}) {
      const World world = mesh ? test::texturedMeshCube(texture) : test::texturedCube(texture);
      for (int side = 0; side < 6; ++side) {
        OnSide other(world, side);
        for (int i = 0; i < 200; ++i) {
          const double x = -0.03 + 0.0003 * i, y = 0.02 * std::sin(0.1 * i), depth = 0.001;
          EXPECT_NEAR((other.force(x, y, depth) - first.force(x, y, depth)).norm(), 0,
                      2 * forceTolerance(texture, depth))
              << texture.shape << ' ' << mesh << ' ' << side << ' ' << i;
        }
      }
    }
  }
}

// The steepest textures that may be made: the force leans by 45 degrees at most, and the noise comes to half of its
// bound.
TEST(Texture, TurnsTheForceByAtMost45Degrees) {
  for (const auto& [shape, per_wave, at_least] :
       {std::tuple("sine", 1 / kTurn, 0.99), std::tuple("grid", std::sqrt(2) / kTurn, 0.99),
        std::tuple("noise", 1 / (2.75 * std::sqrt(2)), 0.5)}) {
    OnSide finger(test::texturedCube({.shape = shape, .amplitude = 0.9999 * per_wave * 1e-3, .wavelength = 1e-3}), 3);
    double steepest = 0;
    for (int i = 0; i < 5000; ++i) {
      const Vec3 f = finger.force(0.02 * std::sin(0.7 * i), 0.02 * std::sin(1.1 * i), 0.002);
      steepest = std::max(steepest, std::hypot(f.x(), f.y()) / f.z());
    }
    EXPECT_LE(steepest, 1) << shape;
    EXPECT_GT(steepest, at_least) << shape;
  }
}

TEST(Texture, NeitherAllocatesNorLocks) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  for (const std::string shape : {"sine", "grid", "noise"}) {
    OnSide finger(test::texturedCube({.shape = shape, .wavelength = 2e-3}), 1);
    finger.force(0, 0, 0.001);
    const RealTimeGuard guard;
    for (int i = 0; i < 100; ++i) finger.force(1e-4 * i, 0, 1e-5 * i);
    EXPECT_EQ(guard.violations(), 0) << shape << ' ' << guard.first();
  }
}

}  // namespace
}  // namespace presa
