#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "framework/geometry/closest_point.h"
#include "tests/modules/haptics_proxy/module_fixture.h"

namespace presa {
namespace {

using test::OneFinger;
using testing::ElementsAre;
using testing::HasSubstr;

using test::kR;
using test::kStiffness;

// ---- which stages there are ----------------------------------------------------------------------------------------

TEST(Stages, AreThoseTheSceneNamesAndNoOther) {
  World bare = test::worldOf(Box{{0.1, 0.1, 0.1}});
  EXPECT_THAT(OneFinger(bare).stages(), ElementsAre(HasSubstr("gather"), HasSubstr("proxy"), HasSubstr("spring")));

  World full = test::worldOf(MeshRef{}, false);
  full.meshes[0].haptic = std::make_shared<const TriMesh>(makeSphere(0.02, 1));
  full.scene.materials[0].damping = 1;
  full.scene.materials[0].friction_static = full.scene.materials[0].friction_dynamic = 0.5;
  full.scene.bodies[0].haptic->smooth = true;
  EXPECT_THAT(OneFinger(full).stages(),
              ElementsAre(HasSubstr("interpolate"), HasSubstr("gather"), HasSubstr("proxy"), HasSubstr("friction"),
                          HasSubstr("shading"), HasSubstr("spring"), HasSubstr("damping")));

  full.scene.haptics = {"penalty", false, HapticSettings::PoseUse::kHold};
  EXPECT_THAT(OneFinger(full).stages(), ElementsAre(HasSubstr("last dynamics step"), HasSubstr("gather"),
                                                    HasSubstr("penalty"), HasSubstr("spring"), HasSubstr("damping")));
  // a material used by no touchable body requires no stage
  World unused = bare;
  unused.scene.materials.resize(2);
  unused.scene.materials[1].damping = unused.scene.materials[1].friction_static = 1;
  EXPECT_EQ(OneFinger(unused).stages(), OneFinger(bare).stages());
}

// ---- damping -------------------------------------------------------------------------------------------------------

// f = k depth - d v to rounding, and never a pulling force.
TEST(Damping, ActsAgainstTheVelocityAlongTheNormal) {
  World world = test::worldOf(Box{{0.1, 0.1, 0.1}});
  world.scene.materials[0].damping = 5;
  OneFinger finger(world);
  const double height = 0.05 + kR;
  finger.tick({0, 0, height + 0.001});
  const Vec3 pressed(0, 0, height - 0.002);
  EXPECT_NEAR(finger.tick(pressed, {0.1, 0, -0.1}).normal_force, kStiffness * 0.002 + 5 * 0.1, 1e-9);
  EXPECT_EQ(finger.tick(pressed, {0, 0, 1}).normal_force, 0);
}

// ---- surfaces that change ------------------------------------------------------------------------------------------

// A finger that sticks with T = k x inside the old cone and outside the new one slips in the tick of the change, with
// the force mu_d N of the new surface. Inside the old cone nothing changes, and in free air nothing happens.
TEST(SurfaceChange, LetsAFingerSlipThatTheNewConeDoesNotHold) {
  World world = test::worldOf(Box{{0.1, 0.1, 0.1}});
  Material& material = world.scene.materials[0];
  material.friction_static = 1.2;
  material.friction_dynamic = 1.1;
  EXPECT_THAT(OneFinger(world).stages(), testing::Not(testing::Contains(HasSubstr("surface change"))));
  material.changed_friction = {.mu_static = 0.4, .mu_dynamic = 0.3};
  const double height = 0.05 + kR, depth = 0.002, normal = kStiffness * depth;
  for (const double way : {0.7e-3, 1e-3}) {  // 0.35 and 0.5 times the normal force
    OneFinger finger(world);
    EXPECT_THAT(finger.stages(), testing::Contains(HasSubstr("with other coefficients after the surface change")));
    finger.tick({0, 0, height + 0.001});
    finger.tick({0, 0, height - depth});
    const FingerContact before = finger.tick({way, 0, height - depth});
    EXPECT_EQ(before.mode, ContactMode::kStick);
    EXPECT_NEAR(before.tangential_force_W.norm(), kStiffness * way, 1e-9);
    EXPECT_EQ(before.friction_static, 1.2);
    finger.surfaces().happened = true;
    const FingerContact after = finger.tick({way, 0, height - depth});
    const bool slips = kStiffness * way > 0.4 * normal;
    EXPECT_EQ(after.mode, slips ? ContactMode::kSlip : ContactMode::kStick);
    EXPECT_NEAR(after.tangential_force_W.norm(), slips ? 0.3 * normal : kStiffness * way, 1e-6 * normal);
    EXPECT_NEAR(after.normal_force, before.normal_force, 1e-6 * normal);
    EXPECT_EQ(after.friction_static, 0.4);
    EXPECT_EQ(after.friction_dynamic, 0.3);
  }
}

// ---- pose ----------------------------------------------------------------------------------------------------------

// A box that rises by 1 mm during a dynamics step, touched in the middle of the step: half-way up, or at its end pose.
TEST(Pose, IsInterpolatedToNowOrHeldAtTheEndOfTheStep) {
  for (const auto use : {HapticSettings::PoseUse::kInterpolate, HapticSettings::PoseUse::kHold}) {
    World world = test::worldOf(Box{{0.1, 0.1, 0.1}}, false);
    world.scene.haptics.pose = use;
    OneFinger finger(world);
    const double height = 0.05 + kR;
    finger.tick({0, 0, height + 0.001});
    finger.objects().time_end = 0.005;
    finger.objects().bodies[0].X_WB_end.p = {0, 0, 0.001};
    const double depth = finger.tick({0, 0, height - 0.001}, Vec3::Zero(), 0.0025).depth;
    EXPECT_NEAR(depth, use == HapticSettings::PoseUse::kHold ? 0.002 : 0.0015, 1e-6 * kR);
  }
}

// ---- penalty -------------------------------------------------------------------------------------------------------

// On a thick body both renderers give the same spring force.
TEST(Penalty, IsTheGodObjectOnAThickFace) {
  World world = test::worldOf(Box{{0.1, 0.1, 0.1}});
  OneFinger god_object(world);
  world.scene.haptics = {.renderer = "penalty", .proxy = false};
  OneFinger penalty(world);
  for (double z = 0.06; z > 0.045; z -= 1e-4) {
    const Vec3 f = god_object.tick({0.01, 0.005, z}).f_H_W;
    EXPECT_NEAR((penalty.tick({0.01, 0.005, z}).f_H_W - f).norm(), 0, kStiffness * 1e-6 * kR);
  }
  EXPECT_EQ(penalty.all().pop_through, 0u);
}

// A plate of 2 mm, as primitive and as mesh: beyond its middle the nearest surface is the far one. The god-object stays
// on the near side at any depth.
TEST(Penalty, PopsThroughAThinPlateWhichTheGodObjectHolds) {
  const TriMesh plate = makeBox({0.1, 0.1, 0.002});
  for (const bool mesh : {false, true}) {
    World world = mesh ? test::worldOf(MeshRef{}) : test::worldOf(Box{{0.1, 0.1, 0.002}});
    if (mesh) world.meshes[0].haptic = std::make_shared<const TriMesh>(plate);
    OneFinger god_object(world);
    world.scene.haptics = {.renderer = "penalty", .proxy = false};
    OneFinger penalty(world);
    Vec3 held = Vec3::Zero(), popped = Vec3::Zero();
    for (OneFinger* finger : {&god_object, &penalty}) {
      for (double z = 0.02; z > -0.003; z -= 1e-4)
        (finger == &god_object ? held : popped) = finger->tick({0, 0, z}).f_H_W;
    }
    const double z = -0.003 + 1e-4;  // last height above -3 mm
    EXPECT_NEAR(held.z(), kStiffness * (0.001 + kR - z), 0.11) << mesh;
    EXPECT_NEAR(popped.z(), -kStiffness * (kR - (-z - 0.001)), 0.11) << mesh;
    EXPECT_EQ(god_object.all().pop_through, 0u);
    EXPECT_EQ(penalty.all().pop_through, 1u);
  }
}

// ---- force shading -------------------------------------------------------------------------------------------------

// A coarse sphere (80 facets): the vertex normals, which are radial, interpolate over a facet to the radial direction
// of the touched point. That point is the mesh point nearest to the HIP, found by testing every facet.
TEST(Shading, TurnsTheForceIntoTheInterpolatedNormal) {
  World world = test::worldOf(MeshRef{});
  const auto mesh = std::make_shared<const TriMesh>(makeSphere(0.03, 1));
  world.meshes[0].haptic = mesh;
  OneFinger faceted(world);
  world.scene.bodies[0].haptic->smooth = true;
  OneFinger smooth(world);
  double worst_faceted = 0;
  for (int i = -1; i < 1000; ++i) {
    const double a = 0.002 * i;
    const Vec3 u = Vec3(std::sin(a), 0.3, std::cos(a)).normalized();
    const Vec3 p_WH = (i < 0 ? 0.05 : 0.033) * u;
    const FingerContact f = faceted.tick(p_WH), s = smooth.tick(p_WH);
    if (i < 0) continue;
    Vec3 touched = Vec3::Constant(1e9);
    for (const TriMesh::Triangle& t : mesh->triangles) {
      const auto at = [&](std::size_t k) -> const Vec3& { return mesh->vertices[static_cast<std::size_t>(t[k])]; };
      const Vec3 q = closestOnTriangle(p_WH, at(0), at(1), at(2));
      if ((q - p_WH).norm() < (touched - p_WH).norm()) touched = q;
    }
    // the proxy ends within 1e-6 r of the optimum, and each step starts from the end of the last one
    ASSERT_NEAR((s.nhat_W - touched.normalized()).norm(), 0, 1e-4) << i;
    ASSERT_NEAR(s.normal_force, f.normal_force, 1e-9);
    // the force on the body is the spring between proxy and HIP: it must be the same force
    ASSERT_NEAR((s.f_H_W - kStiffness * (s.p_WP - p_WH)).norm(), 0, 1e-9);
    worst_faceted = std::max(worst_faceted, (f.nhat_W - u).norm());
  }
  EXPECT_GT(worst_faceted, 0.1);  // without shading the facets are 6 degrees off
}

// At a corner of a cube three faces meet in four or five triangles. Weighted by their angles, the faces count alike, so
// the normal of the corner is its diagonal; 0.1 mm beside the corner it is within 0.01 of it.
TEST(Shading, WeighsTheTrianglesOfACornerByTheirAngles) {
  constexpr double kHalf = 0.05, kBeside = 1e-4;
  World world = test::worldOf(MeshRef{});
  world.meshes[0].haptic = std::make_shared<const TriMesh>(makeBox(Vec3::Constant(2 * kHalf)));
  world.scene.bodies[0].haptic->smooth = true;
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      OneFinger finger(world);
      const Vec3 above(x * (kHalf - kBeside), y * (kHalf - kBeside), kHalf + kR);
      finger.tick(above + Vec3(0, 0, 0.01));
      const Vec3 nhat = finger.tick(above - Vec3(0, 0, 1e-3)).nhat_W;
      EXPECT_NEAR((nhat - Vec3(x, y, 1).normalized()).norm(), 0, 0.01) << nhat.transpose();
    }
  }
}

// Friction turns with the normal: it stays across it, as large as without shading.
TEST(Shading, LeavesFrictionAcrossTheTurnedNormal) {
  World world = test::worldOf(MeshRef{});
  world.meshes[0].haptic = std::make_shared<const TriMesh>(makeSphere(0.03, 1));
  world.scene.materials[0].friction_static = world.scene.materials[0].friction_dynamic = 1;
  OneFinger faceted(world);
  world.scene.bodies[0].haptic->smooth = true;
  OneFinger smooth(world);
  double turned = 0;
  for (int i = -1; i < 200; ++i) {
    const double a = 0.3 + (i < 0 ? 0 : 1e-4 * i);  // slides by less than friction holds
    const Vec3 p_WH = (i < 0 ? 0.05 : 0.033) * Vec3(std::sin(a), 0.3, std::cos(a)).normalized();
    const FingerContact f = faceted.tick(p_WH), s = smooth.tick(p_WH);
    if (i < 0) continue;
    ASSERT_EQ(s.mode, ContactMode::kStick) << i;
    ASSERT_NEAR(s.tangential_force_W.dot(s.nhat_W), 0, 1e-9) << i;
    ASSERT_NEAR(s.tangential_force_W.norm(), f.tangential_force_W.norm(), 1e-9) << i;
    if (i > 100) turned = std::max(turned, std::abs(f.tangential_force_W.dot(s.nhat_W)));
  }
  EXPECT_GT(turned, 0.01);  // without the turn it would not lie across
}

// In one tick the fingertip goes off a thin plate and round its edge to below it. The straight line between the two
// places crosses the plate; its path does not, and shading must not hide the path from the test for pop-through.
TEST(Shading, CountsNoPopThroughOnAWayRoundAnEdge) {
  for (const bool smooth : {false, true}) {
    World world = test::worldOf(MeshRef{});
    world.meshes[0].haptic = std::make_shared<const TriMesh>(makeBox({0.1, 0.1, 0.002}));
    world.scene.bodies[0].haptic->smooth = smooth;
    OneFinger finger(world);
    finger.tick({0.045, 0, 0.02});
    EXPECT_GT(finger.tick({0.045, 0, 0.005}).normal_force, 0);
    EXPECT_GT(finger.tick({0.0505, 0, -0.0085}).normal_force, 0);
    EXPECT_EQ(finger.all().pop_through, 0u) << smooth;
  }
}

}  // namespace
}  // namespace presa
