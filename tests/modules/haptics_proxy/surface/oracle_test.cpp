// Tests of the oracles themselves, against closed forms.
#include <gtest/gtest.h>

#include <random>

#include "tests/modules/haptics_proxy/surface/support/mesh_oracle.h"
#include "tests/modules/haptics_proxy/surface/support/shapes.h"

namespace presa::test {
namespace {

TEST(Shapes, HaveTheTrianglesThatTheySay) {
  const TriMesh sphere = icosphere(9, 0.05), box = cutBox({0.1, 0.2, 0.3}, 4), level = sheet(0.1, 5);
  EXPECT_EQ(sphere.triangles.size(), 20u * 81u);
  EXPECT_EQ(box.triangles.size(), 12u * 16u);
  EXPECT_EQ(level.triangles.size(), 50u);
  for (const TriMesh* closed : {&sphere, &box}) {
    const MeshReport report = checkMesh(*closed);
    EXPECT_TRUE(report.closed());
    EXPECT_EQ(report.flipped_edges, 0u);
    EXPECT_GT(massProperties(*closed).volume, 0);
  }
  EXPECT_NEAR(massProperties(box).volume, 0.006, 1e-15);  // rounding
}

TEST(MeshOracle, DistanceToABoxIsTheClosedForm) {
  const Vec3 half(0.05, 0.1, 0.15);
  const MeshOracle box(cutBox(2 * half, 7));
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-0.3, 0.3);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p(uniform(random), uniform(random), uniform(random));
    const Vec3 beyond = p.cwiseAbs() - half;
    const double outside = beyond.cwiseMax(Vec3::Zero()).norm(), inside = -beyond.maxCoeff();
    const double expected = outside > 0 ? outside : inside;
    const MeshOracle::Nearest nearest = box.nearest(p);
    EXPECT_NEAR(nearest.distance, expected, 1e-15);  // rounding
    EXPECT_NEAR((nearest.point - p).norm(), expected, 1e-15);
    EXPECT_EQ(box.nearest(p, expected * 0.999).triangle, -1);
    EXPECT_EQ(box.winding(p), outside > 0 ? 0 : 1);
    EXPECT_NEAR(box.solidAngles(p), outside > 0 ? 0 : 1, 1e-9);
  }
  EXPECT_TRUE(box.crosses({0, 0, 0}, {0, 0, 0.16}));
  EXPECT_FALSE(box.crosses({0, 0, 0}, {0, 0, 0.149}));
  EXPECT_TRUE(box.crosses({0, 0, 0.2}, {0.001, 0, -0.2}));
  EXPECT_FALSE(box.crosses({0.06, 0, 0.2}, {0.06, 0, -0.2}));
}

TEST(InsideWatch, KnowsWhetherAPointGotIn) {
  const MeshOracle box(cutBox({0.1, 0.1, 0.1}, 3));
  InsideWatch watch(box);
  EXPECT_FALSE(watch.update({0.06, 0, 0}));
  EXPECT_FALSE(watch.update({0, 0.06, 0}));  // a chord that cuts a corner is no fault
  EXPECT_TRUE(watch.update({0, 0.049, 0}));
  EXPECT_TRUE(watch.update({0, 0.02, 0}));
  EXPECT_FALSE(watch.update({0, 0.051, 0}));
}

}  // namespace
}  // namespace presa::test
