#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "framework/geometry/tri_mesh.h"
#include "modules/view_osg/fewer_facets.h"
#include "modules/view_osg/frame_budget.h"

namespace presa::view {
namespace {

/// Adds `frames` frames that take `whole` [s] at full resolution, plus half a millisecond each.
void draw(FrameBudget& budget, double whole, int frames) {
  for (int i = 0; i < frames; ++i) budget.add(0.0005 + whole * budget.share() * budget.share());
}

TEST(FrameBudget, DrawsLessOfTheWindowUntilFramesComeInTime) {
  FrameBudget budget;
  draw(budget, 0.020, 100);
  EXPECT_EQ(budget.share(), 1);
  draw(budget, 0.045, 100);
  EXPECT_EQ(budget.share(), 0.75);
  draw(budget, 0.200, 100);
  EXPECT_EQ(budget.share(), FrameBudget::kMinShare);  // the minimum, however long a frame takes
  draw(budget, 0.010, 100);
  EXPECT_EQ(budget.share(), 1);
}

TEST(FrameBudget, NeitherSwingsNorMindsAFrameThatWasHeldUp) {
  FrameBudget budget;
  draw(budget, 0.029, 8);
  budget.add(5);
  draw(budget, 0.029, 8);
  EXPECT_EQ(budget.share(), 1);
  draw(budget, 0.045, 30);
  int changes = 0;
  for (int i = 0; i < 300; ++i) {
    const double before = budget.share();
    draw(budget, 0.045, 1);
    changes += budget.share() != before;
  }
  EXPECT_EQ(changes, 0);
}

/// A cylinder with `around` facets in `rows` rows, and its two ends.
TriMesh drum(double radius, double height, int around, int rows) {
  TriMesh mesh;
  for (int row = 0; row <= rows; ++row) {
    for (int i = 0; i < around; ++i) {
      const double turn = 2 * std::numbers::pi * i / around;
      mesh.vertices.push_back({radius * std::cos(turn), radius * std::sin(turn), height * row / rows});
    }
  }
  const auto at = [&](int row, int i) { return row * around + i % around; };
  for (int row = 0; row < rows; ++row) {
    for (int i = 0; i < around; ++i) {
      mesh.triangles.push_back({at(row, i), at(row, i + 1), at(row + 1, i + 1)});
      mesh.triangles.push_back({at(row, i), at(row + 1, i + 1), at(row + 1, i)});
    }
  }
  for (int i = 1; i + 1 < around; ++i) {
    mesh.triangles.push_back({at(0, 0), at(0, i + 1), at(0, i)});
    mesh.triangles.push_back({at(rows, 0), at(rows, i), at(rows, i + 1)});
  }
  return mesh;
}

double volumeOf(const TriMesh& mesh) {
  double six = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto at = [&](std::int32_t i) { return mesh.vertices[static_cast<std::size_t>(i)]; };
    six += at(a).dot(at(b).cross(at(c)));
  }
  return six / 6;
}

TEST(FewerFacets, LeavesOutWhatTheShapeDoesNotNeed) {
  constexpr double kRadius = 0.02, kHeight = 0.08, kTolerance = 0.0002;
  const TriMesh fine = drum(kRadius, kHeight, 80, 12);
  const TriMesh fewer = fewerFacets(fine, kTolerance);
  EXPECT_LT(fewer.triangles.size(), fine.triangles.size() / 3);
  // a surface that moves by the tolerance at most changes the volume by at most this
  const double skin =
      kTolerance * (2 * std::numbers::pi * kRadius * kHeight + 2 * std::numbers::pi * kRadius * kRadius);
  EXPECT_NEAR(volumeOf(fewer), volumeOf(fine), skin);
  for (const Vec3& p : fewer.vertices) {
    EXPECT_LT(std::hypot(p.x(), p.y()), kRadius + kTolerance);
    EXPECT_GT(p.z(), -kTolerance);
    EXPECT_LT(p.z(), kHeight + kTolerance);
  }
}

}  // namespace
}  // namespace presa::view
