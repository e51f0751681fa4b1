#include "framework/geometry/tangent_frame.h"

#include <gtest/gtest.h>

#include <cmath>

namespace presa {
namespace {

// Every plane has one right-handed frame: its normal as z, the foot of the body's origin as origin.
TEST(TangentFrame, IsOneForAllPointsOfAPlane) {
  for (const Vec3& direction : {Vec3(1, 2, 3), Vec3(-1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, 1), Vec3(1, 0.01, 0)}) {
    const Vec3 nhat = direction.normalized();
    const Vec3 across = nhat.unitOrthogonal();
    const Pose X_BT = tangentFrame(nhat, 0.3 * nhat);
    const Pose same = tangentFrame(nhat, 0.3 * nhat + 0.2 * across + 0.1 * nhat.cross(across));
    EXPECT_NEAR((X_BT.p - 0.3 * nhat).norm(), 0, 1e-15);
    EXPECT_NEAR((same.p - X_BT.p).norm(), 0, 1e-15);
    EXPECT_NEAR(same.q.angularDistance(X_BT.q), 0, 1e-12);
    EXPECT_NEAR((X_BT.q * Vec3::UnitZ() - nhat).norm(), 0, 1e-15);
    EXPECT_GE((X_BT.q * Vec3::UnitX()).dot(std::abs(nhat.x()) > 0.99 ? Vec3::UnitY() : Vec3::UnitX()), 0);
  }
}

}  // namespace
}  // namespace presa
