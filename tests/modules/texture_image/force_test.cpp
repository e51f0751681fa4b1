// The force of an image: against a sine, in its place on the face, and over closed loops.
#include <gtest/gtest.h>

#include "framework/core/math/random.h"
#include "tests/modules/texture_image/image_fixture.h"
#include "tests/support/alloc_lock_guard.h"

namespace presa {
namespace {

using test::ImageValues, test::kPlace, test::kStiffness, test::kTurn, test::OnSide, test::pngOf;

constexpr double kAmplitude = 1e-4, kWavelength = 2e-3;

/// One wave of n pixels, at their centres.
std::string sineImage(unsigned n, int bits) {
  return pngOf("sine" + std::to_string(n) + "_" + std::to_string(bits) + ".png", n, 3, bits,
               [n](unsigned x, unsigned) { return 0.5 + 0.5 * std::sin(kTurn * (x + 0.5) / n); });
}

// An image of a sine feels like the sine. The B-spline leaves (2 + cos w) / 3 of its amplitude, w = 2 pi / n, and adds
// waves n - 1 and n + 1 times as long, whose share is 1 / n^4; a sample is rounded by half a level of 2 / (2^bits - 1),
// which steepens the slope by up to a level per pixel.
TEST(SineImage, FeelsLikeTheSine) {
  OnSide sine(test::texturedCube({.shape = "sine", .amplitude = kAmplitude, .wavelength = kWavelength}), 1);
  for (const auto& [pixels, bits] : {std::pair(16U, 16), {64U, 16}, {64U, 8}, {256U, 16}}) {
    OnSide image(test::imageCube({sineImage(pixels, bits), kWavelength, 0.001, kAmplitude}), 1);
    const double w = kTurn / pixels, lost = (1 - std::cos(w)) / 3 + 2 * std::pow(w / kTurn, 4) * pixels;
    const double level = 2 / (std::pow(2, bits) - 1), q = kTurn / kWavelength;
    double worst = 0;
    for (int i = 0; i < 400; ++i) {
      const double x = 0.01 * std::sin(0.7 * i), depth = 0.002;
      const double height = kAmplitude * (lost + level / 2),
                   slope = kAmplitude * (q * lost + level * pixels / kWavelength);
      const double place = kStiffness * kPlace * 2 * (1 + depth * kAmplitude * q * q);
      const double error = (image.force(x, 0.0003, depth) - sine.force(x, 0.0003, depth)).norm();
      EXPECT_LT(error, kStiffness * (height + depth * slope) + place) << pixels << ' ' << bits << ' ' << x;
      worst = std::max(worst, error);
    }
    RecordProperty("worst_N_" + std::to_string(pixels) + "_" + std::to_string(bits), std::to_string(worst));
  }
}

/// Normal force over stiffness less the depth: the height [m].
double heightAt(OnSide& finger, double x, double y) { return finger.force(x, y, 0.001).z() / kStiffness - 0.001; }

// One white pixel of 8 by 4 in black: the second from the left and the uppermost. Tiles of 8 mm by 4 mm begin at the
// origin of the face, with the image's x and y to the right and upwards. A single control point is 4/9 high.
TEST(Image, LiesUprightOnTheFaceAndRepeats) {
  const std::string file = pngOf("pixel.png", 8, 4, 8, [](unsigned x, unsigned y) { return x == 1 && y == 0 ? 1 : 0; });
  for (const double height : {0.004, 0.0}) {  // square pixels are the default
    OnSide finger(test::imageCube({file, 0.008, height, kAmplitude}), 2);
    for (const auto& [x, y, s] : {std::tuple(0.0015, 0.0035, 2 * 4.0 / 9 - 1),
                                  {0.0015 - 0.008, 0.0035 + 0.004, 2 * 4.0 / 9 - 1},
                                  {0.0025, 0.0035, 2 * 1.0 / 9 - 1},
                                  {0.0015, 0.0005, 2 * 1.0 / 9 - 1},
                                  {0.0015, 0.0015, -1.0},
                                  {0.0055, 0.0035, -1.0}})
      EXPECT_NEAR(heightAt(finger, x, y), kAmplitude * (s - 1), 2 * kPlace) << x << ' ' << y;
  }
}

/// Every pixel another, the worst case; as steep as an image may be.
ImageValues roughImage(unsigned width, unsigned height) {
  RandomStream random(5, "pixels");
  const std::string file = pngOf("rough.png", width, height, 8, [&](unsigned, unsigned) { return random.uniform(); });
  return {file, 4e-4 * width, 5e-4 * height, 1e-4};
}

// The force is continuous over the borders of pixels: within 0.2 um it changes by no more than the second derivatives
// of the height allow. A bilinear map would jump by up to k d amplitude 4 / pixel.
TEST(Image, HasAContinuousForce) {
  OnSide finger(test::imageCube(roughImage(8, 6)), 0);
  constexpr double kStep = 2e-7, kDepth = 0.002;
  // s'' of a cubic B-spline: second differences of the pixels, at most 8 / pixel^2 on each axis and 4 / pixel^2 across
  const double curvature = kAmplitude * 12 / (4e-4 * 4e-4),
               most = kStiffness * (kDepth * curvature + 2) * (kStep + 2 * kPlace);
  const double jump = kStiffness * kDepth * kAmplitude / 4e-4;
  EXPECT_LT(most, jump);
  Vec3 last = finger.force(0, 0, kDepth);
  for (int i = 1; i < 16000; ++i) {
    const Vec3 f = finger.force(kStep * i, 0.7 * kStep * i, kDepth);
    EXPECT_LT((f - last).norm(), most) << i;
    last = f;
  }
}

// The crests lie in the face, and the slope keeps its bound.
TEST(Image, BeginsWithoutAJumpAndLeansByAtMost45Degrees) {
  OnSide finger(test::imageCube(roughImage(8, 6)), 5);
  for (int i = 0; i < 2000; ++i) {
    const double x = 0.02 * std::sin(0.7 * i), y = 0.02 * std::sin(1.1 * i);
    EXPECT_LT(finger.force(x, y, 1e-6).norm(), kStiffness * 1.5e-6);
    const Vec3 f = finger.force(x, y, 0.002);
    EXPECT_LT(std::hypot(f.x(), f.y()), f.z());
  }
}

// As for textures, by the trapezoidal rule; halving the step leaves a quarter of its error.
TEST(ALoopOverAnImage, GainsNoEnergy) {
  double coarse = 0, fine = 0;
  for (const bool leaves : {false, true}) {
    for (const int steps : {1500, 3000}) {
      OnSide finger(test::imageCube(roughImage(8, 6)), 3);
      const auto [net, moved] = test::workRound(finger, leaves, steps);
      // 25 mm in 1500 steps of 17 um: 24 and 48 a pixel, which is half of the shortest wave
      EXPECT_LT(std::abs(net) / moved, std::pow(kTurn / (48.0 * steps / 1500), 2) / 12) << leaves << steps;
      EXPECT_GT(moved, 1e-5);
      (steps == 1500 ? coarse : fine) += std::abs(net) / moved;
    }
  }
  EXPECT_LT(fine, std::max(coarse / 2, 4e-5));
}

TEST(Image, NeitherAllocatesNorLocks) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  OnSide finger(test::imageCube(roughImage(8, 6)), 1);
  finger.force(0, 0, 0.001);
  const RealTimeGuard guard;
  for (int i = 0; i < 100; ++i) finger.force(1e-4 * i, 0, 1e-5 * i);
  EXPECT_EQ(guard.violations(), 0) << guard.first();
}

}  // namespace
}  // namespace presa
