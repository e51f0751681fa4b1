#include "experiments/study/box_penetration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "framework/geometry/rotation_between.h"

namespace presa {
namespace {

Pose at(double x, double y, double z, const Quat& q = Quat::Identity()) { return {Vec3(x, y, z), q}; }
Quat turned(double angle, const Vec3& axis) { return Quat(Eigen::AngleAxisd(angle, axis.normalized())); }

TEST(BoxPenetration, OfAlignedBoxesIsTheLeastOverlap) {
  const Vec3 cube(1, 1, 1);
  EXPECT_NEAR(boxPenetration(cube, at(0, 0, 0), cube, at(0.9, 0.2, 0)), 0.1, 1e-15);
  EXPECT_EQ(boxPenetration(cube, at(0, 0, 0), cube, at(1.0001, 0, 0)), 0);
  EXPECT_NEAR(boxPenetration({4, 4, 0.1}, at(0, 0, 0), cube, at(0.3, 0.7, 0.54)), 0.01, 1e-12);
}

// A cube on its edge extends half a face diagonal below its centre; on its corner, half a space diagonal.
TEST(BoxPenetration, OfACubeOnEdgeOrCornerAboveAPlate) {
  const Vec3 plate(10, 10, 1), cube(1, 1, 1);
  const Quat on_edge = turned(std::numbers::pi / 4, Vec3::UnitX());
  EXPECT_NEAR(boxPenetration(plate, at(0, 0, -0.5), cube, at(0, 0, 0.7, on_edge)), std::sqrt(0.5) - 0.7, 1e-12);
  const Quat on_corner = rotationBetween(Vec3(1, 1, 1), Vec3::UnitZ());
  EXPECT_NEAR(boxPenetration(plate, at(0, 0, -0.5), cube, at(0, 0, 0.85, on_corner)), std::sqrt(0.75) - 0.85, 1e-12);
}

// Edges crossed at right angles: the min overlap is along the cross product of the two edges.
TEST(BoxPenetration, OfCrossedEdgesIsFoundByTheirCrossProduct) {
  const Vec3 rod(4, 1, 1);
  const Quat upper = turned(std::numbers::pi / 2, Vec3::UnitZ()) * turned(std::numbers::pi / 4, Vec3::UnitX());
  const Quat lower = turned(std::numbers::pi / 4, Vec3::UnitX());
  EXPECT_NEAR(boxPenetration(rod, at(0, 0, 0, lower), rod, at(0, 0, 1.4, upper)), 2 * std::sqrt(0.5) - 1.4, 1e-12);
  EXPECT_EQ(boxPenetration(rod, at(0, 0, 0, lower), rod, at(0, 0, 1.4143, upper)), 0);
}

// Symmetric in the two boxes and invariant under rigid motion; a translation by the depth separates them.
TEST(BoxPenetration, IsSymmetricAndPartsThemWhenUndone) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> any(-0.6, 0.6);
  int overlaps = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto pose = [&] { return Pose{Vec3(any(random), any(random), any(random)), Quat::UnitRandom()}; };
    const Vec3 a(0.3, 0.5, 0.8), b(0.4, 0.4, 0.4);
    const Pose X_A = pose(), X_B = pose(), X = pose();
    const double depth = boxPenetration(a, X_A, b, X_B);
    EXPECT_NEAR(boxPenetration(b, X_B, a, X_A), depth, 1e-12);
    EXPECT_NEAR(boxPenetration(a, X * X_A, b, X * X_B), depth, 1e-12);
    if (depth == 0) continue;
    ++overlaps;
    // no shorter translation separates them: sampled in 26 directions
    for (int x = -1; x <= 1; ++x) {
      for (int y = -1; y <= 1; ++y) {
        for (int z = -1; z <= 1; ++z) {
          const Vec3 way(x, y, z);
          if (way.isZero()) continue;
          Pose moved = X_B;
          moved.p += 0.999 * depth * way.normalized();
          EXPECT_GT(boxPenetration(a, X_A, b, moved), 0);
        }
      }
    }
  }
  EXPECT_GT(overlaps, 200);
}

}  // namespace
}  // namespace presa
