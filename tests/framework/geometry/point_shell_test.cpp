// Points spread over a surface: on it, evenly, in levels, with edges and corners.
#include "framework/geometry/point_shell.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "framework/core/math/random.h"

namespace presa::point_shell_test {
namespace {

using Vec3f = PointShell::Vec3f;

TriMesh withAdjacency(TriMesh mesh) {
  buildAdjacency(mesh);
  return mesh;
}

double nearestTo(const PointShell& shell, const Vec3& p, std::size_t count) {
  double nearest = 1e9;
  for (std::size_t i = 0; i < count; ++i) nearest = std::min(nearest, (shell.points()[i].cast<double>() - p).norm());
  return nearest;
}

TEST(PointShell, LiesOnTheSurfaceWithItsNormalsOutward) {
  const PointShell shell(withAdjacency(makeSphere(0.05, 5)), 0.003, 100000);
  EXPECT_GT(shell.size(), 1000U);
  for (std::size_t i = 0; i < shell.size(); ++i) {
    EXPECT_NEAR(shell.points()[i].norm(), 0.05F, 1e-4F);
    EXPECT_GT(shell.normals()[i].dot(shell.points()[i].normalized()), 0.99F);
  }
}

// Each level leaves no place farther from a point than its spacing, and has no two points nearer than that, or half of it
// where they are mirror images.
TEST(PointShell, CoversTheSurfaceEvenlyInEachLevel) {
  const TriMesh mesh = withAdjacency(makeSphere(0.05, 5));
  const PointShell shell(mesh, 0.002, 100000);
  ASSERT_GE(shell.levels().size(), 3U);
  RandomStream random(1, "shell");
  for (const PointShell::Level& level : shell.levels()) {
    for (int k = 0; k < 300; ++k) {
      const Vec3 place = Vec3(random.normal(), random.normal(), random.normal()).normalized() * 0.05;
      EXPECT_LT(nearestTo(shell, place, level.points), 1.25 * level.spacing);
      const std::size_t i = random.below(level.points);
      for (std::size_t j = 0; j < level.points; ++j) {
        if (i == j) continue;
        ASSERT_GE((shell.points()[i] - shell.points()[j]).norm(), level.spacing * 0.4999);
      }
    }
  }
}

TEST(PointShell, HasTheCornersAndEdgesOfABox) {
  const PointShell shell(withAdjacency(makeBox({0.04, 0.03, 0.02})), 0.002, 100000);
  int corners = 0, on_edges = 0;
  for (const Vec3f& p : shell.points()) {
    const Vec3 at_limit = (p.cast<double>().cwiseAbs() - Vec3(0.02, 0.015, 0.01)).cwiseAbs();
    const auto limits = (at_limit.array() < 1e-6).count();
    corners += limits == 3;
    on_edges += limits == 2;
  }
  EXPECT_EQ(corners, 8);
  EXPECT_GT(on_edges, 80) << "360 mm of edges, a point each 2 to 4 mm";
}

TEST(PointShell, PutsEachPointIntoOneBlockWithinItsBalls) {
  const PointShell shell(withAdjacency(makeBox({0.04, 0.03, 0.02})), 0.0005, 100000);
  std::vector<int> seen(shell.size(), 0);
  std::uint32_t next_group = 0;
  for (const PointShell::Level& level : shell.levels()) {
    EXPECT_EQ(level.first_group, next_group);
    next_group = level.end_group;
    for (std::uint32_t g = level.first_group; g < level.end_group; ++g) {
      const PointShell::Range& group = shell.groups()[g];
      for (std::uint32_t b = group.first; b < group.end; ++b) {
        const PointShell::Range& block = shell.blocks()[b];
        EXPECT_LE(block.end - block.first, PointShell::kBlock);
        for (std::uint32_t i = block.first; i < block.end; ++i) {
          ++seen[i];
          EXPECT_LE((shell.points()[i] - block.ball.center).norm(), block.ball.radius);
          EXPECT_LE((shell.points()[i] - group.ball.center).norm(), group.ball.radius);
        }
      }
    }
  }
  EXPECT_EQ(next_group, shell.groups().size());
  EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), [](int times) { return times == 1; }));
}

TEST(PointShell, KeepsToItsNumberOfPoints) {
  const TriMesh mesh = withAdjacency(makeSphere(0.05, 4));
  for (const std::size_t max : {8U, 300U, 5000U}) {
    const PointShell shell(mesh, 1e-9, max);
    EXPECT_LE(shell.size(), max);
    EXPECT_GT(shell.size(), max / 3);
  }
}

}  // namespace
}  // namespace presa::point_shell_test
