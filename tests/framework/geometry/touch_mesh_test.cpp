#include "framework/geometry/touch_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "framework/geometry/convex.h"
#include "framework/geometry/decimate.h"
#include "framework/geometry/surface_distance.h"
#include "tests/support/effort.h"

namespace presa {
namespace {

constexpr double kKnown = 1e-6;  // [m]

void expectDistance(const SurfaceDistance& found, double exact, double tolerance = 1e-12) {
  EXPECT_LE(found.low, exact + tolerance);
  EXPECT_GE(found.high, exact - tolerance - 1e-12);  // reached where a fine triangle lies over a coarse one's middle
  EXPECT_LE(found.high - found.low, kKnown * (1 + 1e-9));  // of the two bounds
}

TEST(SurfaceDistance, IsThatOfBoxesOneWayAndTheOther) {
  const TriMesh box = makeBox({0.1, 0.1, 0.1}), tall = makeBox({0.1, 0.1, 0.3}), large = makeBox({0.12, 0.12, 0.12});
  expectDistance(surfaceDistance(box, box, {kKnown}), 0);
  expectDistance(surfaceDistance(large, box, {kKnown}), 0.01 * std::sqrt(3.0));  // corner to corner
  expectDistance(surfaceDistance(box, large, {kKnown}), 0.01);                   // face to face
  expectDistance(surfaceDistance(tall, box, {kKnown}), 0.1);
  // the middle of a square of the short box's ends is 50 mm from the sides of the tall one: no sample of the corners,
  // midpoints and centres of its triangles is that far
  expectDistance(surfaceDistance(box, tall, {kKnown}), 0.05);
}

// The finest sphere stands in for the true one; it is inside by its own sagitta, which is the tolerance.
TEST(SurfaceDistance, OfAPolyhedronInASphereIsItsSagitta) {
  constexpr double kRadius = 0.05;
  const TriMesh fine = makeSphere(kRadius, 6), coarse = makeSphere(kRadius, 2);
  const auto sagitta = [&](const TriMesh& mesh) {
    double largest = 0;
    for (const TriMesh::Triangle& t : mesh.triangles) {
      const auto at = [&](std::size_t i) { return mesh.vertices[static_cast<std::size_t>(t[i])]; };
      const Vec3 n = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
      largest = std::max(largest, kRadius - n.dot(at(0)));
    }
    return largest;
  };
  expectDistance(surfaceDistance(fine, coarse, {kKnown}), sagitta(coarse), sagitta(fine));
  EXPECT_GT(sagitta(coarse), 20 * sagitta(fine));
}

TEST(SurfaceDistance, StopsWhenToldTo) {
  const TriMesh sphere = makeSphere(0.05);
  EXPECT_TRUE(std::isinf(surfaceDistance(sphere, sphere, {kKnown}, [](double) { return false; }).high));
}

TEST(TouchMesh, KeepsTheDistanceThatIsAllowed) {
  const TriMesh sphere = makeSphere(0.05, unlessSanitized(5, 4));
  for (const double allowed : {5e-4, unlessSanitized(1e-4, 4e-4)}) {
    const TouchMesh made = touchMesh(sphere, allowed);
    EXPECT_LE(made.distance(), allowed);
    EXPECT_GT(made.distance(), 0.4 * allowed);  // and uses it
    EXPECT_LT(made.mesh.triangles.size(), sphere.triangles.size() / 2);
    EXPECT_TRUE(checkMesh(made.mesh).closed());
    // bounds against the sampled distance
    const double sampled = hausdorffDistance(sphere, made.mesh);
    EXPECT_GE(made.distance(), sampled - 1e-12);
  }
}

TEST(TouchMesh, IsTheMeshWhereNoneIsCoarser) {
  const TriMesh box = makeBox({0.1, 0.1, 0.1});
  const TouchMesh made = touchMesh(box, 1e-4);
  EXPECT_EQ(made.mesh.triangles.size(), 12u);
  EXPECT_LT(made.distance(), 1e-15);
}

TEST(TouchPieces, AreConvexAndAsFarAsTheySay) {
  const TriMesh sphere = makeSphere(0.05, unlessSanitized(4, 1));
  const TouchPieces made = touchPieces(sphere, 4, 1e-3);
  ASSERT_FALSE(made.pieces.empty());
  EXPECT_LE(made.pieces.size(), 4u);
  for (TriMesh piece : made.pieces) {
    EXPECT_TRUE(isConvex(piece));
    for (Vec3& v : piece.vertices) v = v.cast<float>().cast<double>();  // as in a file
    EXPECT_TRUE(isConvex(piece));
  }
  // a convex polyhedron of up to 64 faces in a sphere: at least half the sagitta of 64 equal triangles (decimate_test)
  EXPECT_GT(made.forth.high, 2 * M_PI * 0.05 / (3 * std::sqrt(3.0) * 64 * 4));
  const double low = std::max(made.forth.low, made.back.low), high = std::max(made.forth.high, made.back.high);
  EXPECT_GE(high, hausdorffDistance(sphere, made.pieces) - 1e-12);
  EXPECT_LE(high - low, 0.1 * std::sqrt(3.0) / 500 + 1e-12);
}

}  // namespace
}  // namespace presa
