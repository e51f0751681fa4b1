// A finger that comes back has neither gained nor lost energy, also while friction holds it.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/modules/layers/layers_fixture.h"

namespace presa {
namespace {

using test::forceAt, test::kPlace, test::kStiffness, test::LayerValues, test::layeredCube, test::OnLayers;

/// Work of the force on the finger along straight lines through `corners` (x, y, depth), by the trapezoidal rule.
double workAlong(OnLayers& finger, const std::vector<Vec3>& corners, int steps, int* slips = nullptr) {
  double work = 0;
  Vec3 last_p = corners[0], last_f = finger.force(last_p.x(), last_p.y(), last_p.z());
  for (std::size_t c = 1; c < corners.size(); ++c) {
    for (int i = 1; i <= steps; ++i) {
      const Vec3 p = corners[c - 1] + static_cast<double>(i) / steps * (corners[c] - corners[c - 1]);
      const Vec3 f = finger.force(p.x(), p.y(), p.z());
      if (slips != nullptr && finger.slips()) ++*slips;
      const Vec3 way = p - last_p;
      work += 0.5 * (f + last_f).dot(Vec3(way.x(), way.y(), -way.z()));  // the depth grows against z
      last_p = p;
      last_f = f;
    }
  }
  return work;
}

// Down and up through the same places: the sums cancel but for the place of the proxy, over twice the depth.
TEST(LayersPressedAndReleased, GiveBackWhatTheyTook) {
  constexpr double kDeep = 0.006;
  OnLayers finger(layeredCube({}));
  const double stored = -workAlong(finger, {{0, 0, -0.001}, {0, 0, kDeep}}, 700);
  const double back = workAlong(finger, {{0, 0, kDeep}, {0, 0, -0.001}}, 700);
  EXPECT_NEAR(stored, back, kStiffness * kPlace * 2 * kDeep);
  // 0.2 k over 2 mm, then linear to k over 1 mm, then k: f = 0.4 N, 1 N, 4 N; the energy is the integral, in the
  // transition by Simpson's rule, exact for a force of second degree. The trapezoidal rule errs by step^2 / 12 times
  // the change of the slope, which is k.
  const LayerValues values;
  const double closed = 0.5 * 0.4 * 2e-3 + (0.4 + 4 * forceAt(2.5e-3, values) + 1) / 6 * 1e-3 + 0.5 * (1 + 4) * 3e-3;
  EXPECT_NEAR(stored, closed, 1e-10 / 12 * kStiffness + kStiffness * kPlace * 2 * kDeep);
}

/// In, along, deeper, back, out, while friction holds the finger at the place of the first touch.
std::vector<Vec3> loop(double stretch, double shallow, double deep) {
  return {{0, 0, -1e-4}, {0, 0, shallow}, {stretch, 0, shallow}, {stretch, 0, deep}, {0, 0, deep}, {0, 0, -1e-4}};
}

// Friction of the ratio t / d would store k f(d1) / d1 t^2 / 2 in the shallow stretch and give back that of d2.
TEST(LayersThatStick, GainNoEnergyWhereTheStretchComesBackDeeper) {
  constexpr double kShallow = 0.002, kDeep = 0.006, kStretch = 0.0009;  // within 0.5 of the shallow depth
  const LayerValues values;
  const double ratio_would_gain =
      0.5 * kStretch * kStretch * (forceAt(kDeep, values) / kDeep - forceAt(kShallow, values) / kShallow);
  EXPECT_GT(ratio_would_gain, 1.5e-4);  // [J]
  for (const int steps : {200, 800}) {
    int slips = 0;
    OnLayers finger(layeredCube(values, 0.5, 0.5));
    const double gained = workAlong(finger, loop(kStretch, kShallow, kDeep), steps, &slips);
    // trapezoidal rule: step^2 / 12 times the change of the slope, k at most on each way; place of the proxy on the way
    const double step = kDeep / steps;
    EXPECT_NEAR(gained, 0, 4 * step * step / 12 * kStiffness + kStiffness * kPlace * 4 * kDeep) << steps;
    EXPECT_LT(std::abs(gained), 0.01 * ratio_would_gain) << steps;
    EXPECT_EQ(slips, 0) << steps;
  }
}

// A loop with sliding in it costs the finger energy.
TEST(LayersThatSlide, TakeEnergy) {
  for (const double dynamic : {0.5, 0.3}) {
    OnLayers finger(layeredCube({}, 0.5, dynamic));
    int slips = 0;
    EXPECT_LT(workAlong(finger, loop(0.004, 0.002, 0.006), 800, &slips), 0) << dynamic;
    EXPECT_GT(slips, 0);
  }
}

}  // namespace
}  // namespace presa
