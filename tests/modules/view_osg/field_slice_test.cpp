#include "modules/view_osg/field_slice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "framework/scene/load.h"
#include "modules/view_osg/slice_plane.h"

namespace presa::view {
namespace {

const Quat kTurned(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));

AxisBox boxOf(const Vec3& half) { return {-half, half}; }

// It contains the tool's long axis whatever the eye, and shows it as much of its face as such a plane can.
TEST(SlicePlane, GoesAlongTheToolAndFacesTheEye) {
  const Pose X_WT{{0.1, -0.2, 0.3}, kTurned};
  const Vec3 along = X_WT.q * Vec3::UnitZ();
  for (const Vec3& eye : {Vec3(1, 0, 0), Vec3(-0.3, 0.8, 2), Vec3(0.1, -2, -0.3)}) {
    const SlicePlane plane = planeThrough(boxOf({0.01, 0.01, 0.05}), X_WT, eye);
    const Vec3 normal = plane.X_WS.q * Vec3::UnitZ(), sight = (eye - X_WT.p).normalized();
    EXPECT_NEAR(normal.dot(along), 0, 1e-12);
    EXPECT_NEAR(normal.dot(sight), std::sqrt(1 - std::pow(sight.dot(along), 2)), 1e-12);
    EXPECT_LT((plane.X_WS.p - X_WT.p).norm(), 1e-15);
    EXPECT_GT(plane.half_x, 0.05);
    EXPECT_GT(plane.half_y, 0.01);
  }
  EXPECT_TRUE(planeThrough(boxOf({0.01, 0.01, 0.05}), X_WT, X_WT.p + along).X_WS.q.coeffs().allFinite());
}

TEST(SlicePlane, OfAFlatToolIsItsOwnPlane) {
  const SlicePlane plane = planeThrough(boxOf({0.03, 0.029, 0.004}), {{0, 0, 0}, kTurned}, kTurned * Vec3(1, 1, -0.4));
  EXPECT_NEAR((plane.X_WS.q * Vec3::UnitZ()).dot(kTurned * Vec3::UnitZ()), -1, 1e-12);
}

ToolField ball(std::int32_t body, double radius) {
  return {body, 0, [radius](const Vec3& p_B) { return p_B.norm() - radius; }};
}

// Of two balls the nearer one; in single precision.
TEST(SliceGrid, HoldsTheDistanceOfTheNearestBody) {
  const SlicePlane plane{{{0.01, 0.02, 0.03}, kTurned}, 0.04, 0.02};
  const std::vector<Pose> X_WB{{{0.02, 0.02, 0.03}, kTurned}, {{-0.03, 0.01, 0.02}, Quat::Identity()}};
  const SliceGrid grid = distancesOn(plane, {ball(0, 0.01), ball(1, 0.02)}, X_WB, {0.01, 0.02}, 0.01);
  EXPECT_EQ(grid.values.size(), static_cast<std::size_t>(grid.columns * grid.rows));
  EXPECT_NEAR(2.0 * (grid.rows - 1), grid.columns - 1, 1);  // square cells
  for (int j = 0; j < grid.rows; ++j) {
    for (int i = 0; i < grid.columns; ++i) {
      const Vec3 p_W =
          plane.X_WS * Vec3(0.04 * (2.0 * i / (grid.columns - 1) - 1), 0.02 * (2.0 * j / (grid.rows - 1) - 1), 0);
      const double nearest = std::min((p_W - X_WB[0].p).norm() - 0.01, (p_W - X_WB[1].p).norm() - 0.02);
      EXPECT_NEAR(grid.values[static_cast<std::size_t>(j * grid.columns + i)], std::min(nearest, 0.02), 1e-8);
    }
  }
}

TEST(SliceGrid, AsksNoBodyThatIsFarAway) {
  int asked = 0;
  const ToolField far{0, 0, [&](const Vec3&) { return ++asked, 0.0; }};
  const SliceGrid grid = distancesOn({{}, 0.01, 0.01}, {far}, {{{1, 0, 0}, Quat::Identity()}}, {0.1}, 0.005);
  EXPECT_EQ(asked, 0);
  EXPECT_EQ(*std::ranges::max_element(grid.values), 0.01F);
}

// The plane cuts an upright cylinder in a rectangle; its sides are its diameter, less what its facets leave, and its length.
TEST(Outline, IsWhereThePlaneCutsTheTool) {
  TriMesh rod = makeCylinder(0.01, 0.06, 64);
  const SlicePlane plane = planeThrough(boundsOf(rod), {}, {1, 0.3, 0});
  Vec3 low = Vec3::Constant(1), high = -low;
  const std::vector<Vec3> ends = outlineOn(plane, rod, {});
  ASSERT_GE(ends.size(), 8U);
  EXPECT_EQ(ends.size() % 2, 0U);
  for (const Vec3& end : ends) {
    EXPECT_NEAR(end.z(), 0, 1e-12);
    low = low.cwiseMin(end);
    high = high.cwiseMax(end);
  }
  EXPECT_NEAR(high.x() - low.x(), 0.06, 1e-12);
  EXPECT_NEAR(high.y() - low.y(), 0.02, 0.02 * 2.5e-3);
}

// Nothing is there before it is shown, and no field is looked for.
TEST(FieldSlice, IsThereOnlyOnceItIsShown) {
  Diagnostics diagnostics;
  Scene scene = loadScene(std::string(PRESA_SOURCE_DIR) + "/config/scenes/peg_in_hole.xml", {}, diagnostics);
  ASSERT_EQ(scene.bodies.back().name, "socket");
  scene.bodies.pop_back();  // the table is exact: nothing takes time to build
  const World world = buildWorld(std::move(scene), {}, diagnostics);
  ASSERT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  osg::ref_ptr<osg::Group> space = new osg::Group, left = new osg::Group;
  FieldSlice slice(world, *space, *left, inkOn(PictureOptions::Background::kScene));
  ViewFrame frame;
  frame.X_WB.resize(world.scene.bodies.size());
  std::vector<FingerView> fingers(1);
  fingers[0].valid = fingers[0].has_volume = true;
  fingers[0].X_WT.p = {0, 0, 0.05};
  slice.show(false, frame, fingers);
  EXPECT_EQ(space->getNumChildren() + left->getNumChildren(), 0U);
  slice.show(true, frame, fingers);
  slice.seenFrom({{0.3, -0.4, 0.2}, {0, 0, 0}});
  ASSERT_EQ(space->getNumChildren(), 1U);
  EXPECT_NE(space->getChild(0)->getNodeMask(), 0U);
  EXPECT_EQ(left->getNumChildren(), 1U) << "the scale";
  std::vector<double> appearance;
  slice.appendAppearance(appearance);
  EXPECT_FALSE(appearance.empty());
  slice.show(false, frame, fingers);
  EXPECT_EQ(space->getChild(0)->getNodeMask(), 0U);
  EXPECT_EQ(left->getChild(0)->getNodeMask(), 0U);
}

}  // namespace
}  // namespace presa::view
