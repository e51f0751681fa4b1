#include "framework/geometry/decimate.h"

#include <gtest/gtest.h>

namespace presa {
namespace {

TEST(Hausdorff, IsTheDistanceOfParallelSurfacesAndOfAMissingCorner) {
  const TriMesh small = makeSphere(0.05), large = makeSphere(0.06);
  EXPECT_NEAR(hausdorffDistance(small, large), 0.01, 0.0001);  // chords of the triangulation are 0.12 % short
  EXPECT_LT(hausdorffDistance(small, small), 1e-15);
  // a long box against a short one: only one of the two directed distances is 0.1 m
  const TriMesh box = makeBox({0.1, 0.1, 0.1}), tall = makeBox({0.1, 0.1, 0.3});
  EXPECT_NEAR(hausdorffDistance(box, tall), 0.1, 1e-12);
  EXPECT_NEAR(hausdorffDistance(tall, box), 0.1, 1e-12);
}

// On a sphere of n triangles the distance falls as 1 / n. The optimum, n equal triangles between two spheres,
// has half their sagitta 4 π r / (3 √3 n).
TEST(Decimate, KeepsTheShapeAsFarAsTheTrianglesGo) {
  const TriMesh sphere = makeSphere(0.05, 5);
  double finer = 0;
  for (const std::size_t wanted : {4096u, 1024u, 256u}) {
    const TriMesh coarse = decimateMesh(sphere, wanted);
    EXPECT_LE(coarse.triangles.size(), wanted);
    EXPECT_GE(coarse.triangles.size(), wanted * 9 / 10);
    const MeshReport report = checkMesh(coarse);
    EXPECT_TRUE(report.closed()) << wanted;
    EXPECT_EQ(report.flipped_edges, 0u) << wanted;
    const double distance = hausdorffDistance(sphere, coarse);
    EXPECT_GT(distance, 2 * M_PI * 0.05 / (3 * std::sqrt(3.0) * static_cast<double>(wanted))) << wanted;
    if (finer > 0) {
      EXPECT_NEAR(std::log(distance / finer) / std::log(4.0), 1, 0.25) << wanted;
    }
    finer = distance;
  }
}

// The library aborts where it is asked for more triangles than there are.
TEST(Decimate, LeavesAMeshAsItIsThatHasNoMore) {
  const TriMesh box = makeBox({0.1, 0.1, 0.1});
  for (const std::size_t wanted : {12u, 13u, 4000u}) {
    const TriMesh same = decimateMesh(box, wanted);
    EXPECT_EQ(same.triangles, box.triangles) << wanted;
    EXPECT_EQ(same.vertices, box.vertices) << wanted;
  }
}

}  // namespace
}  // namespace presa
