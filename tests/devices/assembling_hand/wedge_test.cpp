#include "devices/assembling_hand/wedge.h"

#include <gtest/gtest.h>

#include <cmath>

namespace presa::assembling {
namespace {

/// Half of a gable: 160 mm long, 6 mm high at one end and 42 mm at the other, 30 mm thick; its top is +z.
World gable() {
  World world;
  world.scene.materials.emplace_back().friction_dynamic = 0.6;
  world.scene.bodies.emplace_back().physics = Geometry{MeshRef{}, {}, {}};
  auto mesh = std::make_shared<TriMesh>();
  const double x = 0.08, y = 0.015, low = -0.021, left = -0.015, right = 0.021;
  mesh->vertices = {{-x, -y, low}, {x, -y, low}, {x, -y, right}, {-x, -y, left},
                    {-x, y, low},  {x, y, low},  {x, y, right},  {-x, y, left}};
  mesh->triangles = {{0, 1, 2}, {0, 2, 3}, {5, 4, 7}, {5, 7, 6}, {4, 0, 3}, {4, 3, 7},
                     {1, 5, 6}, {1, 6, 2}, {3, 2, 6}, {3, 6, 7}, {4, 5, 1}, {4, 1, 0}};
  world.meshes.resize(1);
  world.meshes[0].physics = mesh;
  world.inertias = {{0.2, Vec3(0.0195, 0, -0.0067), Mat3::Identity()}};
  return world;
}

// The gable lies on its face, with its top along the ground. The only line above its middle that ends on both upright
// ends is inclined.
TEST(Wedge, IsHeldByItsEndsOnALineThatLeans) {
  const World world = gable();
  const Pose lies{{0, 0, 0.015}, Quat(Eigen::AngleAxisd(EIGEN_PI / 2, Vec3::UnitX()))};
  const auto grasp = graspOfLyingMesh(world, 0, lies, Vec3::UnitZ(), 0);
  ASSERT_TRUE(grasp);
  EXPECT_NEAR((lies.q * grasp->a_B).z(), 0, 1e-12) << "level";
  for (const double side : {-1.0, 1.0}) {
    const Vec3 touched = grasp->p_BC + side * grasp->half * grasp->a_B;
    EXPECT_NEAR(std::abs(touched.x()), 0.08, 1e-9) << "an end, not the slope";
    EXPECT_GT(touched.z(), -0.021);
    EXPECT_LT(touched.z(), touched.x() > 0 ? 0.021 : -0.015);
  }
  // above the centre of mass, so that the top comes up, and inclined by less than the friction angle
  const Vec3 to_middle = world.inertias[0].p_BCm - grasp->p_BC;
  EXPECT_LT((to_middle - to_middle.dot(grasp->a_B) * grasp->a_B).z(), -0.002);
  EXPECT_GT(std::abs(grasp->a_B.x()), std::cos(std::atan(0.6)));
}

TEST(Wedge, NoLineWhereTheEndsAreTooLow) {
  World world = gable();
  world.inertias[0].p_BCm.z() = 0.02;
  EXPECT_FALSE(graspOfLyingMesh(world, 0, {{0, 0, 0.015}, Quat(Eigen::AngleAxisd(EIGEN_PI / 2, Vec3::UnitX()))},
                                Vec3::UnitZ(), 0));
}

TEST(Wedge, IsOnlyForMeshes) {
  World world = gable();
  world.scene.bodies[0].physics = Geometry{Box{{0.1, 0.1, 0.1}}, {}, {}};
  EXPECT_FALSE(graspOfLyingMesh(world, 0, {}, Vec3::UnitZ(), 0));
}

}  // namespace
}  // namespace presa::assembling
