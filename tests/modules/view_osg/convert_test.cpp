#include <gtest/gtest.h>
#include <numbers>

#include "modules/view_osg/osg_convert.h"

namespace presa::view {
namespace {

// OSG multiplies row vectors and orders quaternions x, y, z, w; Eigen's constructor takes w first. A quarter turn about
// z followed by (1, 2, 3) maps (x, y, z) to (1 - y, 2 + x, 3 + z): box corners worked out by hand, without a library.
TEST(Convert, PoseMovesBoxCornersAsWorkedOutByHand) {
  const double half = std::numbers::sqrt2 / 2;
  const Pose X_WB{{1, 2, 3}, Quat(half, 0, 0, half)};
  const osg::Matrixd matrix = toOsg(X_WB);
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.2, 0.2})
      for (const double z : {-0.1, 0.1}) {
        const osg::Vec3d corner = osg::Vec3d(x, y, z) * matrix;
        // `half` is rounded: products of two differ from 1/2 by an ulp; lengths here are below 4
        EXPECT_NEAR(corner.x(), 1 - y, 4e-15);
        EXPECT_NEAR(corner.y(), 2 + x, 4e-15);
        EXPECT_NEAR(corner.z(), 3 + z, 4e-15);
      }
}

// The same with all components non-zero and one negative: a third of a turn about (1, 1, -1) maps (x, y, z) to (y, -z,
// -x) exactly.
TEST(Convert, ThirdOfATurnAboutADiagonalCyclesAxes) {
  const osg::Matrixd matrix = toOsg(Pose{Vec3::Zero(), Quat(0.5, 0.5, 0.5, -0.5)});
  EXPECT_EQ(osg::Vec3d(1, 2, 3) * matrix, osg::Vec3d(2, -3, -1));
}

// Body in world, geometry in body: nested transforms multiply from the inside out.
TEST(Convert, NestedTransformsComposeAsPosesDo) {
  const Pose X_WB{{0.3, -0.2, 0.7}, Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()))};
  const Pose X_BG{{-0.1, 0.4, 0.2}, Quat(Eigen::AngleAxisd(-1.9, Vec3(0, 3, 1).normalized()))};
  const osg::Vec3d nested = osg::Vec3d(0.1, 0.2, 0.3) * (toOsg(X_BG) * toOsg(X_WB));
  const Vec3 expected = (X_WB * X_BG) * Vec3(0.1, 0.2, 0.3);
  EXPECT_LT((Vec3(nested.x(), nested.y(), nested.z()) - expected).norm(), 1e-14);  // rounding of order-one numbers
}

// Arrows and cones are unit shapes along z: the tip must be at origin + length * direction, also straight down, where
// the rotation from z is not unique.
TEST(Convert, AlongZPutsTheTipWhereTheForcePoints) {
  for (const Vec3& direction : {Vec3(0.3, -0.4, 0.5), Vec3(0, 0, -2), Vec3(0, 0, 3), Vec3(-1, 0, 0)}) {
    const osg::Vec3d tip = osg::Vec3d(0, 0, 1) * alongZ({1, 2, 3}, direction, {0.1, 0.1, 0.25});
    const Vec3 expected = Vec3(1, 2, 3) + 0.25 * direction.normalized();
    EXPECT_LT((Vec3(tip.x(), tip.y(), tip.z()) - expected).norm(), 1e-14);
  }
}

}  // namespace
}  // namespace presa::view
