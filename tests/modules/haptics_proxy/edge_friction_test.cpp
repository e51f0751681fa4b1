// Friction before an edge: the frictionless point is round the edge as soon as the HIP is past the face, but friction
// still holds the fingertip on the face. There it must feel Coulomb friction of that face until it reaches the edge.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/modules/haptics_proxy/module_fixture.h"

namespace presa {
namespace {

using test::kR;
using test::kStiffness;

constexpr double kToEdge = 0.035;                // from the middle of the box [m]
constexpr double kStatic = 0.8, kDynamic = 0.6;  // coefficients of friction
constexpr double kDrawn = 1.5e-4;                // of the HIP in a tick [m]

test::OneFinger onABox() {
  World world = test::worldOf(Box{{2 * kToEdge, 2 * kToEdge, 2 * kToEdge}}, false);
  world.scene.materials[0].friction_static = kStatic;
  world.scene.materials[0].friction_dynamic = kDynamic;
  return test::OneFinger(std::move(world));
}

class BeforeAnEdge : public testing::TestWithParam<double> {};

constexpr double kSamePlane = 8 * std::numbers::pi / 180;  // planes closer than this count as one

// The HIP is pressed into the face at x = -35 mm and drawn up over the edge at z = 35 mm. While the fingertip is on the
// face, its spring is stretched by the depth, and by the dynamic coefficient times the depth along the face: within 3 %,
// as the frictionless point may be up to 8 degrees round the edge, where the depth is 2 % less and the plane tilted.
TEST_P(BeforeAnEdge, FrictionIsThatOfTheFace) {
  const double depth = GetParam(), x = -kToEdge - kR + depth;
  test::OneFinger finger = onABox();
  for (int i = 0; i <= 100; ++i) finger.tick({x - 1.1e-4 * (100 - i), 0, 0});
  int slid = 0;
  for (double z = 0; z < kToEdge + kR + 0.01; z += kDrawn) {
    const FingerContact& contact = finger.tick({x, 0, z});
    if (contact.p_BP.z() > kToEdge || contact.mode != ContactMode::kSlip) continue;
    ++slid;
    const Vec3 force = contact.normal_force * contact.nhat_W + contact.tangential_force_W;
    const double normal = kStiffness * depth;
    EXPECT_NEAR(-force.x(), normal, 1e-3) << z;
    EXPECT_NEAR(-force.z(), kDynamic * normal, 0.03 * kDynamic * normal) << z;
  }
  // from the HIP's way of static friction on, to the edge and the lag of dynamic friction beyond; 2 ticks at the ends
  EXPECT_GE(slid, static_cast<int>((kToEdge - (kStatic - kDynamic) * depth) / kDrawn) - 2);
}

// Round the edge, the normal of the frictionless point is up to 8 degrees from that of the fingertip.
TEST_P(BeforeAnEdge, ForcesStayWithinTheCone) {
  const double depth = GetParam(), x = -kToEdge - kR + depth;
  const double max_ratio = std::tan(std::atan(kStatic) + kSamePlane);
  test::OneFinger finger = onABox();
  for (int i = 0; i <= 100; ++i) finger.tick({x - 1.1e-4 * (100 - i), 0, 0});
  for (double z = 0; z < kToEdge + kR + 0.01; z += kDrawn) {
    const FingerContact& contact = finger.tick({x, 0, z});
    if (contact.mode == ContactMode::kNone) continue;
    EXPECT_LE(contact.tangential_force_W.norm(), max_ratio * contact.normal_force + 0.01) << z;
  }
}

INSTANTIATE_TEST_SUITE_P(Depth, BeforeAnEdge, testing::Values(0.003, 0.006, 0.012));

}  // namespace
}  // namespace presa
