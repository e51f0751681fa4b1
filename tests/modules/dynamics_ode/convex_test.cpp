#include <algorithm>
#include <random>

#include "tests/modules/dynamics_ode/hull_support.h"
#include "tests/modules/dynamics_ode/support.h"
#include "tests/support/effort.h"

// Contacts of convex polyhedra. Oracle of the gap: the separating axis test by brute force, over all face normals and all
// cross products of edges, each with both hulls' support.
namespace presa::ode {
namespace {

Hull placedAt(const Hull& hull, const Pose& X) {
  Hull out;
  place(hull, X, out);
  return out;
}

double gapAlong(const Hull& A, const Hull& B, const Vec3& nhat) {
  double out_of_a = -1e300, into_b = 1e300;
  for (const Vec3& v : A.vertices) out_of_a = std::max(out_of_a, nhat.dot(v));
  for (const Vec3& v : B.vertices) into_b = std::min(into_b, nhat.dot(v));
  return into_b - out_of_a;
}

double bestGap(const Hull& A, const Hull& B) {
  std::vector<Vec3> axes;
  for (const Hull* hull : {&A, &B}) {
    for (const Hull::Face& face : hull->faces) axes.push_back(face.nhat);
  }
  for (const Vec3& a : A.directions) {
    for (const Vec3& b : B.directions) {
      const Vec3 n = a.cross(b);
      if (n.norm() > 1e-3) axes.push_back(n.normalized());
    }
  }
  double best = -1e300;
  for (const Vec3& axis : axes) best = std::max({best, gapAlong(A, B, axis), gapAlong(A, B, -axis)});
  return best;
}

TEST(Manifold, DepthIsThatOfTheAxisOfLeastOverlap) {
  std::mt19937 generator(3);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto turned = [&] {
    return Quat(normal(generator), normal(generator), normal(generator), normal(generator)).normalized();
  };
  constexpr int kPairs = unlessSanitized(20000, 2000);
  int overlaps = 0, edges = 0;
  for (int n = 0; n < kPairs; ++n) {
    const Hull A = placedAt(boxHull({1, 0.6, 0.4}), {Vec3::Zero(), turned()});
    const Vec3 p = 0.9 * Vec3(uniform(generator), uniform(generator), uniform(generator));
    const Hull B = placedAt(boxHull(Vec3::Constant(0.5)), {p, turned()});
    const double best = bestGap(A, B);
    const Manifold manifold = contactOf(A, B, 0.05);
    if (best > 0.05) {
      ASSERT_EQ(manifold.count, 0) << n;
    }
    if (best > 0) continue;  // beside an edge the distance is larger than along every axis
    ++overlaps;
    ASSERT_GT(manifold.count, 0) << n;
    // a face that overlaps by 1e-4 of the size more is preferred to a pair of edges
    ASSERT_NEAR(deepest(manifold), best, 1e-4) << n;
    ASSERT_NEAR(gapAlong(A, B, manifold.nhat_AB_W), best, 1e-4) << n;
    const double straightest = std::max_element(A.faces.begin(), A.faces.end(), [&](const auto& a, const auto& b) {
                                 return a.nhat.dot(manifold.nhat_AB_W) < b.nhat.dot(manifold.nhat_AB_W);
                               })->nhat.dot(manifold.nhat_AB_W);
    if (straightest < 1 - 1e-9) ++edges;
  }
  EXPECT_GT(overlaps, kPairs / 4);
  EXPECT_GT(edges, kPairs / 20);
}

// Two squares turned by 45 degrees meet in an octagon: eight points, all at one depth, no point more.
TEST(Manifold, TwoSquaresMeetInTheirOctagon) {
  const Hull A = placedAt(boxHull(kCube), {});
  const Hull B = placedAt(boxHull(kCube), {{0, 0, kEdge - 1e-5}, turn(radians(45), Vec3::UnitZ())});
  const Manifold manifold = contactOf(A, B, 1e-3);
  ASSERT_EQ(manifold.count, 8);
  EXPECT_LT((manifold.nhat_AB_W - Vec3::UnitZ()).norm(), 1e-12);
  for (const Manifold::Point& point : manifold.points) {
    EXPECT_NEAR(point.gap, -1e-5, 1e-12);
    EXPECT_NEAR(point.p_W.z(), kEdge / 2 - 5e-6, 1e-12);
    const double corner = kEdge / 2 * std::hypot(1, std::sqrt(2.0) - 1);  // of the octagon, from its centre
    EXPECT_NEAR(point.p_W.head<2>().norm(), corner, 1e-12);
  }
}

// A point that touches nothing yet is there with its gap, up to the margin.
TEST(Manifold, PointsWithinTheMarginHaveTheirGap) {
  const Hull A = placedAt(boxHull(kCube), {});
  const Hull B = placedAt(boxHull(kCube), {{0, 0, kEdge + 0.002}, turn(0.02, Vec3::UnitY())});
  const double low = 0.002 - kEdge / 2 * (std::sin(0.02) + std::cos(0.02) - 1), high = low + kEdge * std::sin(0.02);
  EXPECT_EQ(contactOf(A, B, low - 1e-5).count, 0);
  EXPECT_EQ(contactOf(A, B, (low + high) / 2).count, 2);
  const Manifold all = contactOf(A, B, high + 1e-5);
  ASSERT_EQ(all.count, 4);
  for (int i = 0; i < 4; ++i) {
    const double gap = all.points[static_cast<std::size_t>(i)].gap;
    EXPECT_LT(std::min(std::abs(gap - low), std::abs(gap - high)), 1e-5);
  }
}

// The axis of the step before stays while it is nearly the best, and not longer.
TEST(Manifold, TheNormalDoesNotJumpBetweenEqualAxes) {
  ManifoldMaker maker;
  ContactAxis memory;
  Manifold manifold;
  const Hull A = placedAt(boxHull(kCube), {});
  const auto at = [&](double x, double z) {
    maker.collide(A, placedAt(boxHull(kCube), {{x, 0, z}, Quat::Identity()}), 1e-3, memory, manifold);
    return manifold.nhat_AB_W;
  };
  EXPECT_EQ(at(kEdge - 0.0021, kEdge - 0.002), Vec3(Vec3::UnitZ()));
  EXPECT_EQ(at(kEdge - 0.0019, kEdge - 0.002), Vec3(Vec3::UnitZ())) << "0.1 mm better: kept";
  EXPECT_EQ(at(kEdge - 0.0005, kEdge - 0.002), Vec3(Vec3::UnitX()));
}

TEST(Hull, TwelveTrianglesAreSixFaces) {
  const std::optional<Hull> hull = meshHull(twelveTriangles());
  ASSERT_TRUE(hull);
  EXPECT_EQ(hull->faces.size(), 6U);
  EXPECT_EQ(hull->edges.size(), 12U);
  EXPECT_EQ(hull->directions.size(), 3U);
  for (const Hull::Face& face : hull->faces) EXPECT_NEAR(face.offset, kEdge / 2, 1e-12);
}

TEST(Hull, AMeshWithADentOrAHoleIsNone) {
  TriMesh dented = twelveTriangles();
  dented.vertices[7] *= 0.2;
  EXPECT_FALSE(meshHull(dented));
  TriMesh open = twelveTriangles();
  open.triangles.pop_back();
  EXPECT_FALSE(meshHull(open));
}

// Oracle: the signed distance of a point from a box. Centres inside, outside, and a hair beside an edge.
TEST(Sphere, TouchesABoxAsFarAsItsSignedDistance) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Hull box = placedAt(boxHull(kCube), {});
  const double radius = 0.01;
  for (int n = 0; n < 3000; ++n) {
    Vec3 p = 0.8 * kEdge * Vec3(uniform(generator), uniform(generator), uniform(generator));
    if (n % 3 == 0) p.head<2>() = Vec3(kEdge / 2 + 0.009, kEdge / 2 + 1e-4 * uniform(generator), 0).head<2>();
    const Vec3 q = p.cwiseAbs() - 0.5 * kCube;
    const double distance = q.cwiseMax(0).norm() + std::min(0.0, q.maxCoeff());
    const Hull ball = placedAt(sphereHull(radius), {p, Quat::Identity()});
    for (const bool ball_first : {false, true}) {
      const Manifold manifold = ball_first ? contactOf(ball, box, 1) : contactOf(box, ball, 1);
      ASSERT_EQ(manifold.count, 1) << p.transpose();
      EXPECT_NEAR(manifold.points[0].gap, distance - radius, 1e-12);
      const Vec3 away = (p - p.cwiseMin(0.5 * kCube).cwiseMax(-0.5 * kCube)).normalized();
      if (distance > 1e-6) {
        EXPECT_NEAR(manifold.nhat_AB_W.dot(away), ball_first ? -1 : 1, 1e-9);
      }
    }
  }
}

// Rests on the ends of its axis.
TEST(Capsule, LiesOnTwoPoints) {
  const Hull floor = placedAt(boxHull({1, 1, 0.1}), {{0, 0, -0.05}, Quat::Identity()});
  const Hull capsule = placedAt(capsuleHull(0.02, 0.1), {{0.1, 0, 0.0199}, turn(radians(90), Vec3::UnitX())});
  const Manifold manifold = contactOf(floor, capsule, 1e-3);
  ASSERT_EQ(manifold.count, 2);
  for (int i = 0; i < 2; ++i) {
    const Manifold::Point& point = manifold.points[static_cast<std::size_t>(i)];
    EXPECT_NEAR(point.gap, -1e-4, 1e-12);
    EXPECT_NEAR(std::abs(point.p_W.y()), 0.05, 1e-12);
  }
}

// Beside an edge the normal points from the edge to the axis of the capsule.
TEST(Capsule, AtAnEdgeTouchesTheEdge) {
  const Hull box = placedAt(boxHull(kCube), {});
  const Vec3 away = Vec3(1, 0, 1).normalized();
  const Vec3 p = kEdge / 2 * Vec3(1, 0, 1) + (0.01 - 1e-4) * away;
  const Hull capsule = placedAt(capsuleHull(0.01, 0.02), {p, turn(radians(90), Vec3::UnitX())});
  const Manifold manifold = contactOf(box, capsule, 1e-3);
  ASSERT_GE(manifold.count, 1);
  EXPECT_LT((manifold.nhat_AB_W - away).norm(), 1e-9);
  EXPECT_NEAR(deepest(manifold), -1e-4, 1e-9);
}

TEST(Capsule, TwoAlongEachOtherTouchAtBothEnds) {
  const Hull A = placedAt(capsuleHull(0.01, 0.1), {});
  const Hull B = placedAt(capsuleHull(0.01, 0.06), {{0.0199, 0, 0.01}, Quat::Identity()});
  const Manifold manifold = contactOf(A, B, 1e-3);
  ASSERT_EQ(manifold.count, 2);
  EXPECT_NEAR(manifold.points[0].p_W.z(), -0.02, 1e-12);
  EXPECT_NEAR(manifold.points[1].p_W.z(), 0.04, 1e-12);
  EXPECT_NEAR(deepest(manifold), -1e-4, 1e-12);
}

}  // namespace
}  // namespace presa::ode
