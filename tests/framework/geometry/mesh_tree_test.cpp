#include "framework/geometry/mesh_tree.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "framework/geometry/closest_point.h"

namespace presa {
namespace {

std::vector<std::shared_ptr<const TriMesh>> meshes() {
  TriMesh far = makeSphere(0.001, 3);
  for (Vec3& vertex : far.vertices) vertex += Vec3(20, -30, 10);  // small, and far from the origin
  return {std::make_shared<const TriMesh>(makeSphere(0.05, 4)), std::make_shared<const TriMesh>(makeBox({1, 2, 1e-4})),
          std::make_shared<const TriMesh>(makeCylinder(0.02, 0.3)), std::make_shared<const TriMesh>(std::move(far))};
}

double distanceOf(const MeshTree& tree, std::int32_t facet, const Vec3& p) {
  const MeshTree::Facet& f = tree.facet(facet);
  return (p - closestOnTriangle(p, tree.corner(f, 0), tree.corner(f, 1), tree.corner(f, 2))).norm();
}

void collect(const MeshTree& tree, std::int32_t node, std::vector<std::int32_t>& facets) {
  const MeshTree::Node& n = tree.node(node);
  for (std::int32_t f = 0; f < n.count; ++f) facets.push_back(n.first + f);
  if (n.isLeaf()) return;
  collect(tree, n.first, facets);
  collect(tree, n.first + 1, facets);
}

// Random points near the surface, far from it, on it and inside.
std::vector<Vec3> points(const MeshTree& tree, int count) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Vec3> result;
  for (int i = 0; i < count; ++i) {
    const double reach = tree.sphereRadius() * (i % 3 == 0 ? 3 : i % 3 == 1 ? 1 : 0.1);
    const Vec3 from = i % 2 == 0 ? tree.sphereCenter()
                                 : tree.mesh().vertices[static_cast<std::size_t>(i) % tree.mesh().vertices.size()];
    result.push_back(from + reach * Vec3(uniform(random), uniform(random), uniform(random)));
  }
  return result;
}

TEST(MeshTree, HoldsEveryTriangleOnce) {
  for (const auto& mesh : meshes()) {
    const MeshTree tree(mesh);
    std::vector<std::int32_t> facets;
    collect(tree, MeshTree::kRoot, facets);
    std::set<std::int32_t> ids;
    for (const std::int32_t f : facets) ids.insert(tree.facet(f).id);
    EXPECT_EQ(facets.size(), mesh->triangles.size());
    EXPECT_EQ(ids.size(), mesh->triangles.size());
  }
}

// The bound of every node lies below the distance of each of its triangles, at the point where it was taken and at any
// other. Tolerance: rounding of coordinates of up to 30 m in double precision.
TEST(MeshTree, BoundsTheDistanceFromBelowEverywhere) {
  for (const auto& mesh : meshes()) {
    const MeshTree tree(mesh);
    const double rounding = 1e-13 * (tree.sphereCenter().norm() + tree.sphereRadius());
    const std::vector<Vec3> at = points(tree, 40);
    for (std::int32_t node = 0; node < static_cast<std::int32_t>(tree.nodeCount()); node += 1 + node / 16) {
      std::vector<std::int32_t> facets;
      collect(tree, node, facets);
      for (std::size_t i = 0; i < at.size(); ++i) {
        double distance = 0;
        const TangentBound bound = tree.bound(node, at[i], distance);
        EXPECT_NEAR(bound.at(at[i]), distance, rounding);
        for (const Vec3& other : {at[i], at[(i + 1) % at.size()]}) {
          double min = 1e300;
          for (const std::int32_t f : facets) min = std::min(min, distanceOf(tree, f, other));
          ASSERT_LE(bound.at(other), min + rounding) << node;
        }
      }
    }
  }
}

// No triangle within the radius is missing from a cut or a query, for any size of the output.
TEST(MeshTree, CutsAndQueriesAreComplete) {
  for (const auto& mesh : meshes()) {
    const MeshTree tree(mesh);
    std::mt19937_64 random(9);
    std::uniform_real_distribution<double> unit(0, 1);
    for (const Vec3& p : points(tree, 60)) {
      const double radius = tree.sphereRadius() * unit(random);
      std::set<std::int32_t> near, cut_near, queried;
      for (std::int32_t f = 0; f < static_cast<std::int32_t>(mesh->triangles.size()); ++f) {
        if (distanceOf(tree, f, p) <= radius) near.insert(f);
      }
      tree.forEachWithin(p, radius, [&](std::int32_t f) {
        if (distanceOf(tree, f, p) <= radius) queried.insert(f);
      });
      EXPECT_EQ(queried, near);
      for (const std::size_t room : {1, 3, 16}) {
        std::vector<std::int32_t> cut(room), facets;
        cut.resize(tree.cut(p, radius, cut));
        for (const std::int32_t node : cut) collect(tree, node, facets);
        cut_near.clear();
        for (const std::int32_t f : facets) {
          if (distanceOf(tree, f, p) <= radius) {
            EXPECT_TRUE(cut_near.insert(f).second) << "twice";
          }
        }
        EXPECT_EQ(cut_near, near) << room;
      }
    }
  }
}

TEST(MeshTree, RefusesWhatHasNoDistance) {
  EXPECT_THROW(MeshTree(std::make_shared<const TriMesh>()), std::invalid_argument);
  TriMesh broken = makeBox({1, 1, 1});
  broken.vertices[3].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(MeshTree(std::make_shared<const TriMesh>(broken)), std::invalid_argument);
}

}  // namespace
}  // namespace presa
