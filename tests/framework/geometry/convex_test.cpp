#include "framework/geometry/convex.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <numbers>
#include <random>

#include "apps/common/scratch_folder.h"
#include "framework/geometry/long_work.h"
#include "framework/scene/piece_cache.h"
#include "tests/framework/geometry/hollow_meshes.h"

namespace presa {
namespace {

using std::numbers::pi;

double volumeOf(const std::vector<TriMesh>& pieces) {
  double volume = 0;
  for (const TriMesh& piece : pieces) volume += massProperties(piece).volume;
  return volume;
}

void expectClosedAndConvex(const std::vector<TriMesh>& pieces) {
  for (const TriMesh& piece : pieces) {
    EXPECT_TRUE(isConvex(piece));
    EXPECT_TRUE(checkMesh(piece).closed());
    EXPECT_FALSE(checkMesh(piece).inverted);
  }
}

// Oracle: every point is behind every face, and the hull of points on a sphere has all of them as corners.
TEST(ConvexHull, HoldsAllItsPoints) {
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  for (int round = 0; round < 50; ++round) {
    std::vector<Vec3> points;
    for (int i = 0; i < 60; ++i) {
      Vec3 p(normal(generator), normal(generator), normal(generator));
      points.push_back(round % 2 == 0 ? Vec3(p.normalized()) : Vec3((4 * p).array().round() / 4));
    }
    const std::optional<TriMesh> hull = convexHull(points);
    ASSERT_TRUE(hull);
    EXPECT_TRUE(checkMesh(*hull).closed()) << round;
    for (const TriMesh::Triangle& t : hull->triangles) {
      const auto corner = [&](std::size_t i) { return hull->vertices[static_cast<std::size_t>(t[i])]; };
      const Vec3 nhat = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
      for (const Vec3& p : points) EXPECT_LT(nhat.dot(p - corner(0)), 1e-6);
    }
    if (round % 2 == 0) {
      EXPECT_EQ(hull->vertices.size(), points.size());
    }
  }
}

TEST(ConvexHull, OfPointsInAPlaneIsNone) {
  EXPECT_FALSE(convexHull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.3, 0.4, 0}}));
}

// A limited hull is inside of the full one.
TEST(ConvexHull, KeepsToItsLimit) {
  const TriMesh ball = makeSphere(0.05);
  const std::optional<TriMesh> hull = convexHull(ball.vertices, 34);
  ASSERT_TRUE(hull);
  EXPECT_LE(hull->vertices.size(), 34U);
  EXPECT_LE(hull->triangles.size(), 64U);
  EXPECT_LT(massProperties(*hull).volume, massProperties(ball).volume);
}

// A convex solid stays one piece: itself.
TEST(Decompose, LeavesAConvexMeshInOnePiece) {
  const TriMesh box = makeBox({0.1, 0.2, 0.3});
  const std::vector<TriMesh> pieces = decompose(box, 64, 0.001);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_NEAR(massProperties(pieces[0]).volume, 0.1 * 0.2 * 0.3, 1e-12);
}

// An L comes apart into two boxes, and a square frame into four, without a remainder: volume and distance are exact.
TEST(Decompose, CutsPolyhedraExactly) {
  const std::vector<TriMesh> corner =
      decompose(test::extruded({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {0, 2}}, 1), 64, 0.001);
  EXPECT_EQ(corner.size(), 2U);
  EXPECT_NEAR(volumeOf(corner), 4, 1e-6);
  const TriMesh cup = test::cup(4, 0.03 * std::numbers::sqrt2, 0.04 * std::numbers::sqrt2, 0.01, 0.08);
  const std::vector<TriMesh> pieces = decompose(cup, 64, 0.001);
  expectClosedAndConvex(pieces);
  EXPECT_EQ(pieces.size(), 5U);
  EXPECT_NEAR(volumeOf(pieces) / massProperties(cup).volume, 1, 1e-6);
  EXPECT_LT(hausdorffDistance(cup, pieces), 1e-7);
}

// A round cup of 24 sides: its floor and 24 staves.
TEST(Decompose, OpensACup) {
  const TriMesh cup = test::cup(24, 0.03, 0.033, 0.004, 0.08);
  const std::vector<TriMesh> pieces = decompose(cup, 64, 0.001);
  expectClosedAndConvex(pieces);
  EXPECT_EQ(pieces.size(), 25U);
  EXPECT_NEAR(volumeOf(pieces) / massProperties(cup).volume, 1, 1e-6);
  EXPECT_LT(hausdorffDistance(cup, pieces), 1e-7);
}

TEST(Decompose, TellsHowFarItHasComeAndStops) {
  const TriMesh cup = test::cup(24, 0.03, 0.033, 0.004, 0.08);
  std::vector<double> shares;
  const auto told = [&](std::size_t calls) {
    return [&shares, calls](double share) {
      shares.push_back(share);
      return shares.size() < calls;
    };
  };
  decompose(cup, 64, 0.001, told(1000));
  EXPECT_GT(shares.size(), 20U);
  EXPECT_TRUE(std::ranges::is_sorted(shares));
  EXPECT_GE(shares.front(), 0);
  EXPECT_LE(shares.back(), 1);
  shares.clear();
  EXPECT_TRUE(decompose(cup, 64, 0.001, told(5)).empty());
  EXPECT_EQ(shares.size(), 5U);
}

// The listener of the thread that loads hears of a cut and may end it.
TEST(CutIntoPieces, TellsTheListenerWhichMayStopIt) {
  const ScratchFolder kept;
  ASSERT_EQ(setenv("XDG_CACHE_HOME", kept.path().c_str(), 1), 0);
  const TriMesh cup = test::cup(23, 0.03, 0.033, 0.004, 0.08);
  const Decomposition wanted{.max_pieces = 64, .max_error = 0.001};
  std::vector<double> shares;
  std::string what;
  const LongWorkListener listener([&](const std::string& told, double share) {
    what = told;
    shares.push_back(share);
    return shares.size() != 5;
  });
  EXPECT_THROW(cutIntoPieces(cup, wanted), WorkStopped);
  EXPECT_EQ(what, "convex pieces of a mesh of " + std::to_string(cup.triangles.size()) + " triangles");
  EXPECT_EQ(cutIntoPieces(cup, wanted).pieces.size(), 24U);
  EXPECT_EQ(shares.back(), 1);
  unsetenv("XDG_CACHE_HOME");
}

// The trap: one piece closes the mouth, and the distance says so. The middle of the mouth is a radius of the inner
// polygon, 30 mm cos(pi / 24), from the rim; samples are corners and middles of the hull's triangles, which may be
// nearer.
TEST(Decompose, TooFewPiecesCloseTheMouthAndTheDistanceSaysSo) {
  const TriMesh cup = test::cup(24, 0.03, 0.033, 0.004, 0.08);
  const double distance = hausdorffDistance(cup, decompose(cup, 1, 0.001));
  EXPECT_GT(distance, 0.02);
  EXPECT_LT(distance, 0.03);
}

// A hollow of less than the error allowed is bridged.
TEST(Decompose, BridgesSmallHollows) {
  const TriMesh notched = test::extruded({{0, 0}, {1, 0}, {1, 1}, {0.5, 0.99}, {0, 1}}, 1);
  EXPECT_EQ(decompose(notched, 64, 0.02).size(), 1U);
  EXPECT_GT(decompose(notched, 64, 0.001).size(), 1U);
}

}  // namespace
}  // namespace presa
