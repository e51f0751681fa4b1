#include "modules/collision_fcl/mesh_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "framework/core/math/random.h"
#include "framework/geometry/closest_point.h"
#include "tests/modules/haptics_proxy/surface/support/mesh_files.h"
#include "tests/support/alloc_lock_guard.h"

namespace presa {
namespace {

using Index = CollisionSettings::Index;

/// Distance between a segment and a triangle by a search along the segment: the distance of its points from a convex
/// set is convex in the parameter, so thirds close in on its min.
double searchedDistance(const Vec3& p, const Vec3& q, const std::array<Vec3, 3>& corners) {
  const PreparedTriangle triangle(corners[0], corners[1], corners[2]);
  const auto at = [&](double s) {
    const Vec3 x = p + s * (q - p);
    return (x - closestOnTriangle(x, triangle)).norm();
  };
  double low = 0, high = 1;
  for (int i = 0; i < 90; ++i) {
    const double one = low + (high - low) / 3, two = high - (high - low) / 3;
    (at(one) < at(two) ? high : low) = at(one) < at(two) ? two : one;
  }
  return std::min({at(0), at(1), at(low)});
}

/// The same minus `radius`, to the sign only where a ball around the triangle lies clearly within reach or beyond.
double searchedBeyond(const ProbeWay& way, const std::array<Vec3, 3>& corners) {
  const Vec3 middle = (corners[0] + corners[1] + corners[2]) / 3;
  const double size =
      std::max({(corners[0] - middle).norm(), (corners[1] - middle).norm(), (corners[2] - middle).norm()});
  const Vec3 along = way.to - way.from;
  const double share = along.isZero() ? 0 : std::clamp((middle - way.from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  const double beyond = (middle - way.from - share * along).norm() - way.radius;
  if (std::abs(beyond) > 1.1 * size) return beyond;
  return searchedDistance(way.from, way.to, corners) - way.radius;
}

std::array<Vec3, 3> cornersOf(const MeshTree& tree, std::int32_t facet) {
  const MeshTree::Facet& f = tree.facet(facet);
  return {tree.corner(f, 0), tree.corner(f, 1), tree.corner(f, 2)};
}

/// Triangles of all sizes and shapes, some of them without area.
TriMesh soup() {
  RandomStream random(3, "soup");
  TriMesh mesh;
  for (int t = 0; t < 300; ++t) {
    const Vec3 middle(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(-0.02, 0.02));
    const double size = std::pow(10, random.uniform(-5, -1));
    const auto first = static_cast<std::int32_t>(mesh.vertices.size());
    for (int k = 0; k < 3; ++k)
      mesh.vertices.push_back(middle + size * Vec3(random.normal(), random.normal(), random.normal()));
    if (t % 10 == 0) mesh.vertices.back() = mesh.vertices[mesh.vertices.size() - 2];
    if (t % 30 == 0)
      mesh.vertices[mesh.vertices.size() - 2] = mesh.vertices.back() = mesh.vertices[mesh.vertices.size() - 3];
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

/// A plate of twelve triangles under dust: the sizes of triangles differ by a factor of 1e5.
TriMesh plateAndDust() {
  TriMesh mesh = makeBox({1, 1, 0.001});
  RandomStream random(4, "dust");
  for (int t = 0; t < 500; ++t) {
    const Vec3 at(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), 0.01);
    const auto first = static_cast<std::int32_t>(mesh.vertices.size());
    for (const Vec3& corner : {Vec3(0, 0, 0), Vec3(1e-5, 0, 0), Vec3(0, 1e-5, 0)}) mesh.vertices.push_back(at + corner);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

TriMesh named(const std::string& name) {
  if (name == "sphere") return makeSphere(0.05, 5);
  if (name == "box") return makeBox({0.1, 0.2, 0.01});
  if (name == "soup") return soup();
  if (name == "plate_and_dust") return plateAndDust();
  return test::realMesh(name);
}

class EachIndex : public testing::TestWithParam<std::string> {
 protected:
  MeshTree tree_{std::make_shared<const TriMesh>(named(GetParam()))};
  AxisBox bounds_ = boundsOf(tree_.mesh());
  RandomStream random_{1, "queries"};
  FacetSet found_{tree_.mesh().triangles.size()};

  Vec3 somewhere() {
    const Vec3 size = bounds_.high - bounds_.low;
    return bounds_.low +
           size.cwiseProduct(Vec3(random_.uniform(-0.2, 1.2), random_.uniform(-0.2, 1.2), random_.uniform(-0.2, 1.2)));
  }
  /// Balls, short ways and long ones, of every reach from nothing to the whole mesh; most of them near the surface.
  ProbeWay way(int number) {
    const double size = (bounds_.high - bounds_.low).norm();
    ProbeWay way;
    way.from = somewhere();
    if (number % 4 != 0) {
      const auto facet = static_cast<std::int32_t>(random_.below(tree_.mesh().triangles.size()));
      way.from = cornersOf(tree_, facet)[0] + 0.02 * size * Vec3(random_.normal(), random_.normal(), random_.normal());
    }
    way.to = way.from;
    if (number % 3 == 1) way.to += 0.01 * size * Vec3(random_.normal(), random_.normal(), random_.normal());
    if (number % 3 == 2) way.to = somewhere();
    way.radius = number % 7 == 0 ? 0 : size * std::pow(10, random_.uniform(-4, 0));
    return way;
  }
};

// Oracle: every triangle, by a search along the way. Where its distance equals the radius to 1e-9 of the mesh's size
// (the search ends at 3e-16 of the way, the closest point on a sliver is good to 1e-12) either answer is right.
TEST_P(EachIndex, FindsTheTrianglesThatBruteForceFinds) {
  const double close = 1e-9 * (bounds_.high - bounds_.low).norm();
  const auto count = static_cast<std::int32_t>(tree_.mesh().triangles.size());
  const int queries = count > 5000 ? 12 : 120;
  std::map<Index, std::unique_ptr<MeshIndex>> indices;
  for (const Index kind : {Index::kTree, Index::kObb, Index::kHcollide}) indices[kind] = makeMeshIndex(kind, tree_);
  std::size_t hits = 0;
  for (int number = 0; number < queries; ++number) {
    const ProbeWay asked = way(number);
    std::vector<double> beyond;
    for (std::int32_t f = 0; f < count; ++f) beyond.push_back(searchedBeyond(asked, cornersOf(tree_, f)));
    for (auto& [kind, index] : indices) {
      found_.clear();
      index->find(asked, found_);
      hits += found_.all().size();
      std::size_t wrong = 0;
      for (std::int32_t f = 0; f < count; ++f) {
        const double by = beyond[static_cast<std::size_t>(f)];
        if (std::abs(by) > close && found_.has(f) != (by < 0)) ++wrong;
      }
      EXPECT_EQ(wrong, 0u) << "index " << static_cast<int>(kind) << ", query " << number;
      std::vector<std::int32_t> all(found_.all().begin(), found_.all().end());
      std::ranges::sort(all);
      EXPECT_EQ(std::ranges::adjacent_find(all), all.end()) << "a triangle twice";
    }
  }
  EXPECT_GT(hits, 100u);
}

// What an index found stays in the cut: in one of its nodes.
TEST_P(EachIndex, GivesACutThatHoldsWhatItFound) {
  for (const Index kind : {Index::kObb, Index::kHcollide}) {
    const auto index = makeMeshIndex(kind, tree_);
    for (int number = 0; number < 60; ++number) {
      found_.clear();
      index->find(way(number), found_);
      std::array<std::int32_t, kMaxCutNodes> cut{};
      const std::size_t count = cutAround(found_, tree_, cut);
      EXPECT_EQ(count == 0, found_.all().empty());
      FacetSet held(tree_.mesh().triangles.size());
      for (std::size_t i = 0; i < count; ++i) {
        const auto hold = [&](std::int32_t facet) { held.add(facet); };
        tree_.forEachWithin(Vec3::Zero(), 1e9, hold, cut[i]);
      }
      EXPECT_TRUE(std::ranges::all_of(found_.all(), [&](std::int32_t f) { return held.has(f); })) << number;
    }
  }
}

TEST_P(EachIndex, NeitherAllocatesNorLocksInAQuery) {
  for (const Index kind : {Index::kTree, Index::kObb, Index::kHcollide}) {
    const auto index = makeMeshIndex(kind, tree_);
    std::array<std::int32_t, kMaxCutNodes> cut{};
    RealTimeGuard guard;
    for (int number = 0; number < 60; ++number) {
      found_.clear();
      index->find(way(number), found_);
      cutAround(found_, tree_, cut);
    }
    EXPECT_EQ(guard.violations(), 0) << guard.first();
  }
}

INSTANTIATE_TEST_SUITE_P(OnMeshes, EachIndex,
                         testing::Values("box", "soup", "plate_and_dust", "sphere", "femur", "fandisk", "knot2"),
                         [](const auto& of) { return of.param; });

// Every range of a set of random facets against a count one by one; sizes around 64 bits and their square.
TEST(FacetSet, KnowsWhetherARangeHasAny) {
  RandomStream random(5, "facets");
  for (const std::int32_t count : {1, 63, 64, 65, 200, 4096, 4097, 9000}) {
    FacetSet set(static_cast<std::size_t>(count));
    for (int round = 0; round < 20; ++round) {
      set.clear();
      std::vector<std::int32_t> all;
      for (int i = 0; i < 3 + 10 * (round % 2); ++i) {
        all.push_back(static_cast<std::int32_t>(random.below(static_cast<std::uint64_t>(count))));
        set.add(all.back());
      }
      for (int i = 0; i < 200; ++i) {
        auto begin = static_cast<std::int32_t>(random.below(static_cast<std::uint64_t>(count) + 1));
        auto end = static_cast<std::int32_t>(random.below(static_cast<std::uint64_t>(count) + 1));
        if (begin > end) std::swap(begin, end);
        const bool any = std::ranges::any_of(all, [&](std::int32_t f) { return f >= begin && f < end; });
        ASSERT_EQ(set.hasAny(begin, end), any) << count << ": " << begin << " to " << end;
      }
    }
  }
}

}  // namespace
}  // namespace presa
