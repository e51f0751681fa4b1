#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "framework/haptics/convex_piece.h"

namespace presa {
namespace {

ConvexPiece triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  return {.body = 0, .id = -1, .shape = PreparedTriangle(a, b, c)};
}

Vec3 randomVec(std::mt19937_64& random, double scale) {
  std::uniform_real_distribution<double> uniform(-scale, scale);
  return {uniform(random), uniform(random), uniform(random)};
}

// Oracle: the nearest point of a grid over the triangle, refined around the best point; no Voronoi regions.
double gridDistance(const ConvexPiece& t, const Vec3& p) {
  const auto& corners = std::get<PreparedTriangle>(t.shape);
  double best = 1e300, u0 = 0.5, v0 = 0.5, span = 0.5;
  for (int level = 0; level < 12; ++level) {
    double bu = u0, bv = v0;
    for (int i = -10; i <= 10; ++i) {
      for (int j = -10; j <= 10; ++j) {
        const double u = std::clamp(u0 + span * i / 10, 0.0, 1.0);
        const double v = std::clamp(v0 + span * j / 10, 0.0, 1.0 - u);
        const double d = (corners.a + u * corners.ab + v * corners.ac - p).norm();
        if (d < best) best = d, bu = u, bv = v;
      }
    }
    u0 = bu, v0 = bv, span *= 0.4;
  }
  return best;
}

// Tolerance: the grid ends at a spacing of 0.5 * 0.4^12 / 10 of the triangle; the distance error is of second order.
TEST(ConvexPiece, TriangleDistanceMatchesARefinedGrid) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 300; ++i) {
    const ConvexPiece t = triangle(randomVec(random, 1), randomVec(random, 1), randomVec(random, 1));
    const Vec3 p = randomVec(random, 2);
    EXPECT_NEAR(nearest(t, p).distance, gridDistance(t, p), 1e-5);
  }
}

// For every kind of piece the normal is the gradient of the distance (central differences, second order: 1e-6 at step
// 1e-5).
TEST(ConvexPiece, NormalIsGradientOfDistance) {
  std::mt19937_64 random(2);
  std::vector<ConvexPiece> pieces{triangle({0, 0, 0}, {0.7, 0, 0.1}, {0.2, 0.6, 0})};
  for (const auto kind :
       {Primitive::Kind::kBox, Primitive::Kind::kSphere, Primitive::Kind::kCylinder, Primitive::Kind::kCapsule}) {
    Primitive primitive{.kind = kind, .X_AG = {}, .half = {0.3, 0.2, 0.5}, .radius = 0.3, .half_length = 0.4};
    primitive.X_AG.p = {0.1, -0.2, 0.05};
    primitive.X_AG.q = Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
    pieces.push_back({.body = 0, .id = -1, .shape = primitive});
  }
  for (const ConvexPiece& piece : pieces) {
    for (int i = 0; i < 200; ++i) {
      const Vec3 p = randomVec(random, 1.5);
      const Nearest at = nearest(piece, p);
      if (at.distance < 1e-2) continue;  // the gradient jumps on the surface of a two-sided triangle
      EXPECT_NEAR(at.nhat.norm(), 1, 1e-12);
      for (int axis = 0; axis < 3; ++axis) {
        const Vec3 step = 1e-5 * Vec3::Unit(axis);
        const double slope = (nearest(piece, p + step).distance - nearest(piece, p - step).distance) / 2e-5;
        EXPECT_NEAR(at.nhat[axis], slope, 1e-4) << (&piece - pieces.data());
      }
    }
  }
}

// Inside a solid primitive the distance is minus the depth, and the normal points to the nearest surface.
TEST(ConvexPiece, DistanceInsideIsMinusTheDepth) {
  Primitive box{.kind = Primitive::Kind::kBox, .X_AG = {}, .half = {1, 2, 3}};
  const Nearest at = nearest({.body = 0, .id = -1, .shape = box}, {0.9, 0, 0});
  EXPECT_NEAR(at.distance, -0.1, 1e-15);
  EXPECT_EQ(at.nhat, Vec3::UnitX());
  const Primitive round{
      .kind = Primitive::Kind::kCylinder, .X_AG = {}, .half = Vec3::Zero(), .radius = 1, .half_length = 2};
  const ConvexPiece cylinder{.body = 0, .id = -1, .shape = round};
  EXPECT_NEAR(nearest(cylinder, {0.5, 0, 1.8}).distance, -0.2, 1e-15);
  EXPECT_NEAR(nearest(cylinder, {0, 0.9, 0}).distance, -0.1, 1e-15);
}

double sweep(const ConvexPiece& piece, const Vec3& x, const Vec3& move, double r, double tolerance) {
  return firstTouch(piece, nearest(piece, x), x, move, 1, r, tolerance);
}

// A sphere flying at a plane face from distance h touches after (h - r) / h of the way.
TEST(ConvexPiece, SweepStopsWhereTheSphereTouches) {
  const ConvexPiece t = triangle({-1, -1, 0}, {1, -1, 0}, {0, 2, 0});
  EXPECT_NEAR(sweep(t, {0, 0, 0.5}, {0, 0, -1}, 0.1, 1e-9), 0.4, 1e-9);
  EXPECT_GT(sweep(t, {0, 0, 0.5}, {0, 0, 1}, 0.1, 1e-9), 1);
  EXPECT_GT(sweep(t, {0, 0, 0.5}, {0, 0, -0.3}, 0.1, 1e-9), 1);
  // past the corner at (0, 2, 0): r^2 = 0.06^2 + 0.08^2
  EXPECT_NEAR(sweep(t, {0, 2.06, 0.5}, {0, 0, -1}, 0.1, 1e-9), 0.5 - 0.08, 1e-8);
}

// The sweep finds the same first touch as a thousand samples along the path.
TEST(ConvexPiece, SweepMatchesDenseSampling) {
  std::mt19937_64 random(3);
  int hits = 0;
  for (int i = 0; i < 3000; ++i) {
    const ConvexPiece t = triangle(randomVec(random, 1), randomVec(random, 1), randomVec(random, 1));
    const Vec3 x = randomVec(random, 2), move = randomVec(random, 3);
    const double r = 0.2;
    if (nearest(t, x).distance < r) continue;
    double sampled = 2;
    for (int s = 0; s <= 1000 && sampled > 1; ++s) {
      if (nearest(t, x + move * (s / 1000.0)).distance <= r) sampled = s / 1000.0;
    }
    const double found = sweep(t, x, move, r, 1e-9);
    if (sampled <= 1) {
      ++hits;
      EXPECT_LE(found, sampled + 1e-12);
      EXPECT_GE(found, sampled - 1e-3 - 1e-9);
    } else if (found <= 1) {
      // a grazing touch between two samples must be a real touch
      EXPECT_NEAR(nearest(t, x + found * move).distance, r, 1e-6);
    }
  }
  EXPECT_GT(hits, 50);
}

}  // namespace
}  // namespace presa
