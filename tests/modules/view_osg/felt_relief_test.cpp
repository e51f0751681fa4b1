#include "modules/view_osg/felt_relief.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "framework/scene/load.h"
#include "tests/modules/view_osg/pinch_world.h"

namespace presa::view {
namespace {

const Pose kPlaced{Vec3(0.3, -0.2, 0.1), Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()))};

/// A block of 120 x 80 x 20 mm with ridges across x: 0.1 mm high, 2 mm apart. The shipped scene.
std::shared_ptr<World> ridges(bool mesh) {
  Diagnostics diagnostics;
  Scene scene = loadScene(std::string(PRESA_SOURCE_DIR) + "/config/scenes/texture_sine.xml", {}, diagnostics);
  EXPECT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  auto world = std::make_shared<World>();
  world->scene = std::move(scene);
  world->meshes.resize(1);
  if (mesh) {
    const Vec3 size = std::get<Box>(world->scene.bodies[0].haptic->shape).size;
    world->scene.bodies[0].haptic->shape = MeshRef{};
    world->meshes[0].haptic_tree = std::make_shared<const MeshTree>(std::make_shared<const TriMesh>(makeBox(size)));
  }
  return world;
}

ContactExchange touching(const Vec3& p_BC) {
  ContactExchange contacts(1);
  contacts.fingers[0].mode = ContactMode::kSlip;
  contacts.fingers[0].body = 0;
  contacts.fingers[0].p_BC = p_BC;
  return contacts;
}

const osg::Geometry& geometryOf(FeltRelief& relief) { return *relief.root()->asGeometry(); }

class Relief : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(On, Relief, testing::Bool(),
                         [](const auto& of) { return std::string(of.param ? "Mesh" : "Box"); });

// Every corner lies over the touched side, and is as light as its ridge is high. Single precision places a corner to
// 3e-8 m; a ridge rises by 2 pi of its height in 2 mm.
TEST_P(Relief, ShowsTheRidgesOfTheTouchedSideUpToItsEdges) {
  const auto world = ridges(GetParam());
  FeltRelief relief(*world);
  relief.update(true, touching({0.055, 0.01, 0.01}), {kPlaced});
  EXPECT_EQ(relief.root()->getNodeMask(), ~0U);
  const auto* corners = dynamic_cast<const osg::Vec3Array*>(geometryOf(relief).getVertexArray());
  const auto* colors = dynamic_cast<const osg::Vec4Array*>(geometryOf(relief).getColorArray());
  ASSERT_NE(corners, nullptr);
  ASSERT_EQ(colors->size(), corners->size());
  double area = 0;
  for (std::size_t i = 0; i < corners->size(); ++i) {
    const Vec3 p_B = kPlaced.inverseTimes({(*corners)[i].x(), (*corners)[i].y(), (*corners)[i].z()});
    EXPECT_NEAR(p_B.z(), 0.01 + 2e-4, 1e-6);
    EXPECT_LT(p_B.x(), 0.06 + 3e-4);  // half a block
    const double ridge = (1 + std::sin(2 * std::numbers::pi * p_B.x() / 0.002)) / 2;
    EXPECT_NEAR((*colors)[i].r(), 0.02 + 0.98 * ridge, 1e-3);
  }
  const auto* triangles = dynamic_cast<const osg::DrawElementsUInt*>(geometryOf(relief).getPrimitiveSet(0));
  for (std::size_t t = 0; t + 2 < triangles->size(); t += 3) {
    const osg::Vec3 &a = (*corners)[(*triangles)[t]], &b = (*corners)[(*triangles)[t + 1]],
                    &c = (*corners)[(*triangles)[t + 2]];
    area += ((b - a) ^ (c - a)).length() / 2;
  }
  // a disc of 15 mm cut off 5 mm from its middle; blocks of 0.6 mm leave steps of half a block around it
  const double r = 0.015, cut = 0.005;
  const double whole = r * r * (std::numbers::pi - std::acos(cut / r)) + cut * std::sqrt(r * r - cut * cut);
  EXPECT_NEAR(area, whole, 0.03 * whole);
}

// On the side across the body's x axis the tangent frame's x axis is the body's y axis.
TEST_P(Relief, HasTheTangentFrameOfTheTouchedSide) {
  const auto world = ridges(GetParam());
  FeltRelief relief(*world);
  relief.update(true, touching({0.06, 0.0103, 0.002}), {kPlaced});
  const auto* corners = dynamic_cast<const osg::Vec3Array*>(geometryOf(relief).getVertexArray());
  const auto* colors = dynamic_cast<const osg::Vec4Array*>(geometryOf(relief).getColorArray());
  ASSERT_GT(corners->size(), 1000u);
  for (std::size_t i = 0; i < corners->size(); ++i) {
    const Vec3 p_B = kPlaced.inverseTimes({(*corners)[i].x(), (*corners)[i].y(), (*corners)[i].z()});
    EXPECT_NEAR(p_B.x(), 0.06 + 2e-4, 1e-6);
    const double ridge = (1 + std::sin(2 * std::numbers::pi * p_B.y() / 0.002)) / 2;
    EXPECT_NEAR((*colors)[i].r(), 0.02 + 0.98 * ridge, 1e-3);
  }
}

TEST_P(Relief, IsThereOnlyWhereATextureIsFeltAndOnDemand) {
  const auto world = ridges(GetParam());
  FeltRelief relief(*world);
  relief.update(false, touching({0, 0, 0.01}), {kPlaced});
  EXPECT_EQ(relief.root()->getNodeMask(), 0U);
  relief.update(true, ContactExchange(1), {kPlaced});
  EXPECT_EQ(dynamic_cast<const osg::Vec3Array*>(geometryOf(relief).getVertexArray())->size(), 0u);
}

TEST(NoRelief, OfASceneWithoutTexturesIsHidden) {
  const view_test::PinchRun run = view_test::makePinchRun(RunOptions::View::kOffscreen, "");
  FeltRelief relief(*run.world);
  relief.update(true, touching({0, 0, 0.035}), {Pose{}, Pose{}});
  EXPECT_EQ(relief.root()->getNodeMask(), 0U);
}

}  // namespace
}  // namespace presa::view
