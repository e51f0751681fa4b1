#include "modules/collision_fcl/triangle_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "framework/geometry/closest_point.h"

namespace presa {
namespace {

using MeshPointer = std::shared_ptr<const TriMesh>;

/// Thin and needle-like triangles of all sizes, not a surface: what a hierarchy of boxes likes least.
MeshPointer makeSlivers(int count) {
  std::mt19937_64 random(17);
  std::normal_distribution<double> normal;
  TriMesh mesh;
  for (int i = 0; i < count; ++i) {
    const Vec3 start = 0.05 * Vec3(normal(random), normal(random), normal(random));
    const Vec3 along = 0.02 * Vec3(normal(random), normal(random), normal(random));
    const Vec3 aside = std::pow(10.0, -3 - i % 8) * Vec3(normal(random), normal(random), normal(random));
    for (const Vec3& p : {start, Vec3(start + along), Vec3(start + 0.3 * along + aside)}) mesh.vertices.push_back(p);
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return std::make_shared<const TriMesh>(std::move(mesh));
}

std::vector<MeshPointer> meshes() {
  TriMesh far = makeCapsule(0.02, 0.06);
  for (Vec3& vertex : far.vertices) vertex += Vec3(3, -5, 2);
  return {std::make_shared<const TriMesh>(makeSphere(0.05, 4)),
          std::make_shared<const TriMesh>(makeBox({0.1, 0.02, 0.3})), std::make_shared<const TriMesh>(far),
          makeSlivers(3000)};
}

std::vector<NearTriangle> bruteForce(const TriMesh& mesh, const Vec3& center) {
  std::vector<NearTriangle> all;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto at = [&](std::size_t i) { return mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][i])]; };
    all.push_back({(center - closestOnTriangle(center, at(0), at(1), at(2))).norm(), static_cast<std::int32_t>(t)});
  }
  std::ranges::sort(all, nearer);
  return all;
}

/// Random query near the surface, with a radius from a tenth of a millimetre to several centimetres.
std::pair<Vec3, double> someQuery(const TriMesh& mesh, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-4, -1.3);
  const Vec3 vertex = mesh.vertices[random() % mesh.vertices.size()];
  return {vertex + 0.005 * Vec3(normal(random), normal(random), normal(random)), std::pow(10.0, uniform(random))};
}

// The index may only save time: the set it finds is the set a look at every triangle finds, to the bit.
TEST(TriangleIndex, FindsExactlyWhatBruteForceFinds) {
  std::mt19937_64 random(1);
  std::size_t found = 0;
  for (const MeshPointer& mesh : meshes()) {
    const TriangleIndex index(mesh);
    std::vector<NearTriangle> near;
    for (int i = 0; i < 100; ++i) {
      const auto [center, radius] = someQuery(*mesh, random);
      const Gathered gathered = index.gather(center, radius, mesh->triangles.size(), near);
      std::ranges::sort(near, nearer);
      std::vector<NearTriangle> expected = bruteForce(*mesh, center);
      std::erase_if(expected, [radius = radius](const NearTriangle& t) { return t.distance > radius; });
      ASSERT_EQ(near.size(), expected.size());
      for (std::size_t k = 0; k < near.size(); ++k) {
        ASSERT_EQ(near[k].id, expected[k].id);
        ASSERT_EQ(near[k].distance, expected[k].distance);
      }
      EXPECT_EQ(gathered.radius, radius);
      EXPECT_FALSE(gathered.capped);
      found += near.size();
    }
  }
  EXPECT_GT(found, 10000u);  // the queries did reach something
}

// With too little room the nearest are kept, and the radius handed back is one within which nothing is missing.
TEST(TriangleIndex, KeepsTheNearestAndTellsTheTruthAboutTheRadiusWhenFull) {
  std::mt19937_64 random(2);
  int capped = 0;
  for (const MeshPointer& mesh : meshes()) {
    const TriangleIndex index(mesh);
    std::vector<NearTriangle> near;
    for (int i = 0; i < 60; ++i) {
      const auto [center, radius] = someQuery(*mesh, random);
      const std::size_t capacity = 1 + random() % 20;
      const Gathered gathered = index.gather(center, radius, capacity, near);
      std::ranges::sort(near, nearer);
      const std::vector<NearTriangle> all = bruteForce(*mesh, center);
      const auto within = static_cast<std::size_t>(
          std::ranges::count_if(all, [radius = radius](const NearTriangle& t) { return t.distance <= radius; }));
      ASSERT_EQ(near.size(), std::min(within, capacity));
      for (std::size_t k = 0; k < near.size(); ++k) EXPECT_EQ(near[k].id, all[k].id);
      if (within > capacity) {
        ++capped;
        EXPECT_TRUE(gathered.capped);
        EXPECT_LT(gathered.radius, radius);
        EXPECT_TRUE(near.size() == all.size() || all[near.size()].distance > gathered.radius);
      }
    }
  }
  EXPECT_GT(capped, 50);
}

// One vertex that is not a number would make the root box infinite or empty, and every query silent.
TEST(TriangleIndex, RefusesWhatCannotBeIndexed) {
  TriMesh mesh = makeBox({1, 1, 1});
  mesh.vertices[3].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(TriangleIndex(std::make_shared<const TriMesh>(mesh)), std::invalid_argument);
  EXPECT_THROW(TriangleIndex(std::make_shared<const TriMesh>()), std::invalid_argument);
}

TEST(TriangleIndex, AnswersNonsenseWithNothing) {
  const TriangleIndex index(std::make_shared<const TriMesh>(makeBox({1, 1, 1})));
  std::vector<NearTriangle> near;
  index.gather(Vec3::Constant(std::numeric_limits<double>::quiet_NaN()), 1, 10, near);
  EXPECT_TRUE(near.empty());
  index.gather(Vec3::Zero(), -1, 10, near);
  EXPECT_TRUE(near.empty());
}

}  // namespace
}  // namespace presa
