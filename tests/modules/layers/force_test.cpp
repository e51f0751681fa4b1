// The force of layers against the integral of the stiffness, and the ratio of friction.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/modules/layers/layers_fixture.h"
#include "tests/support/alloc_lock_guard.h"

namespace presa {
namespace {

using test::forceAt, test::kPlace, test::kStiffness, test::LayerValues, test::layeredCube, test::OnLayers,
    test::stiffnessAt;

constexpr LayerValues kLayers[] = {
    {0.2, 1, 0.002, 0.001}, {0.1, 0.6, 0, 0.004}, {0.5, 0.5, 0.001, 0.001}, {0.05, 0.9, 0.003, 0.0001}};

// The force is uncertain by that of the proxy's place, at a stiffness of 1000 N/m at most.
TEST(Layers, GiveTheIntegralOfTheStiffness) {
  for (const LayerValues& layers : kLayers) {
    OnLayers finger(layeredCube(layers));
    for (int i = 1; i <= 700; ++i) {
      const double depth = 1e-5 * i;
      const Vec3 f = finger.force(0.001 * std::sin(i), 0.001 * std::cos(i), depth);
      EXPECT_NEAR(f.z(), forceAt(depth, layers), kStiffness * kPlace) << depth;
      EXPECT_NEAR(std::hypot(f.x(), f.y()), 0, kStiffness * kPlace) << depth;
    }
  }
}

// The dynamics goes on from a sample with its stiffness: that must be the slope of the force, and stiffness times depth
// the force.
TEST(Layers, TellTheDynamicsTheSlopeOfTheForce) {
  for (const LayerValues& layers : kLayers) {
    OnLayers finger(layeredCube(layers));
    for (int i = 1; i <= 70; ++i) {
      const double depth = 1e-4 * i - 5e-5;
      const FingerContact& contact = finger.at(0, 0, depth);
      // by the steepest change of the stiffness over the place of the proxy
      EXPECT_NEAR(contact.stiffness, stiffnessAt(depth, layers), kStiffness / layers.transition * kPlace) << depth;
      EXPECT_LE(contact.stiffness, kStiffness);
      EXPECT_NEAR(contact.stiffness * contact.depth, contact.normal_force, 1e-12);
      const Vec3 spring = contact.stiffness * (contact.p_WP - contact.p_WH);
      EXPECT_NEAR((spring - contact.f_H_W).norm(), 0, 1e-12);
    }
  }
}

// A sliding finger keeps the dynamic ratio at every depth, a sticking one stays within the static one and reaches it.
TEST(LayersWithFriction, KeepTheRatioOfTheFrictionCone) {
  constexpr double kStatic = 0.6, kDynamic = 0.4, kStep = 1e-6;
  for (const LayerValues& layers : kLayers) {
    for (const double depth : {0.0005, 0.0015, 0.0025, 0.004, 0.006}) {
      OnLayers finger(layeredCube(layers, kStatic, kDynamic));
      double most = 0;
      for (int i = 0; i < 5000; ++i) {
        const FingerContact& contact = finger.at(kStep * i, 0, depth);
        const double ratio = contact.tangential_force_W.norm() / contact.normal_force;
        // the place of the proxy changes the depth under the finger and the stretch
        const double tolerance = 4 * kPlace / depth;
        if (contact.mode == ContactMode::kSlip) {
          EXPECT_NEAR(ratio, kDynamic, tolerance) << depth;
          continue;
        }
        EXPECT_LE(ratio, kStatic * (1 + tolerance)) << depth;
        most = std::max(most, ratio);
      }
      // the last tick before it breaks away is up to a step short of the border
      EXPECT_GT(most, kStatic - stiffnessAt(depth, layers) * 2 * kStep / forceAt(depth, layers)) << depth;
    }
  }
}

// With a texture before the layers, the energy is that of the layers at the depth below the texture's height:
// f = f(d + h) (nhat - grad h).
TEST(LayersBelowATexture, GiveTheGradientOfTheCommonEnergy) {
  const LayerValues layers;
  World world = layeredCube(layers);
  constexpr double kAmplitude = 2e-4, kWavelength = 2e-3, kQ = 2 * 3.14159265358979323846 / kWavelength;
  PluginElement texture = test::elementOf(
      "texture",
      {{"amplitude", kAmplitude}, {"wavelength", kWavelength}, {"direction", 0}, {"across", 0}, {"seed", 0}});
  texture.attributes["shape"] = "sine";
  world.scene.plugin_elements.insert(world.scene.plugin_elements.begin(), texture);
  OnLayers finger(world);
  for (int i = 0; i < 300; ++i) {
    const double x = 0.01 * std::sin(0.7 * i), depth = 0.0005 + 0.005 * std::abs(std::sin(1.3 * i));
    const double h = kAmplitude * (std::sin(kQ * x) - 1), slope = kAmplitude * kQ * std::cos(kQ * x);
    const double force = forceAt(depth + h, layers);
    // what the place of the proxy changes in height and slope
    const double tolerance = kPlace * (4 * kStiffness + force * kAmplitude * kQ * kQ);
    EXPECT_NEAR((finger.force(x, 0, depth) - force * Vec3(-slope, 0, 1)).norm(), 0, tolerance) << x << ' ' << depth;
  }
}

TEST(Layers, NeitherAllocateNorLock) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  OnLayers finger(layeredCube({}, 0.5, 0.4));
  finger.force(0, 0, 0.001);
  const RealTimeGuard guard;
  for (int i = 0; i < 100; ++i) finger.force(1e-4 * i, 0, 5e-5 * i);
  EXPECT_EQ(guard.violations(), 0) << guard.first();
}

}  // namespace
}  // namespace presa
