// Distances of convex solids. Each is certified: points of the two solids at that distance bound it from above, and a
// plane with the solids on its two sides bounds it from below.
#include "framework/geometry/convex_contact/distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "framework/geometry/convex.h"
#include "framework/geometry/convex_contact/cylinder.h"

namespace presa {
namespace {

using Kind = ConvexDistance::Kind;

class Pair {
 public:
  Pair(const Hull& a, const Hull& b) : a_(a), b_(b) {}

  ConvexDistance at(const Pose& X_A, const Pose& X_B, double beyond = 1e9) {
    X_A_ = X_A;
    X_B_ = X_B;
    return distance(placed(a_, X_A), placed(b_, X_B), beyond, memory);
  }
  /// Largest gap of a plane along nhat: a lower bound.
  double planeGap(const Vec3& nhat) {
    DistanceMemory any;
    return planeAlong(placed(a_, X_A_), placed(b_, X_B_), nhat, any).gap;
  }
  SupportingPlane face() { return planeOfFaces(placed(a_, X_A_), placed(b_, X_B_), memory); }
  DistanceMemory memory;

 private:
  static PlacedSupport placed(const SupportOf& support, const Pose& X) {
    return {support, X.q.toRotationMatrix(), X.p};
  }
  SupportOf a_, b_;
  Pose X_A_, X_B_;
};

class Random {
 public:
  Vec3 inCube(double half) { return half * Vec3(uniform_(engine_), uniform_(engine_), uniform_(engine_)); }
  Quat turn() { return Quat(normal_(engine_), normal_(engine_), normal_(engine_), normal_(engine_)).normalized(); }
  double between(double low, double high) { return low + (high - low) * (uniform_(engine_) + 1) / 2; }

 private:
  std::mt19937 engine_{7};
  std::uniform_real_distribution<double> uniform_{-1, 1};
  std::normal_distribution<double> normal_;
};

/// Hull of points on a sphere.
Hull roundHull(Random& random, int points, double radius) {
  std::vector<Vec3> on_sphere;
  for (int i = 0; i < points; ++i) on_sphere.push_back(radius * random.inCube(1).normalized());
  return meshHull(*convexHull(on_sphere), 1e-5, 2000).value();
}

void expectCertified(Pair& pair, const ConvexDistance& found, double tolerance, int trial) {
  ASSERT_EQ(found.kind, Kind::kNearest) << trial;
  EXPECT_NEAR((found.on_b - found.on_a).dot(found.nhat_AB), found.gap, tolerance) << trial;
  EXPECT_NEAR((found.on_b - found.on_a).norm(), std::abs(found.gap), tolerance) << trial;
  EXPECT_NEAR(pair.planeGap(found.nhat_AB), found.gap, tolerance) << trial;
}

TEST(ConvexDistance, OfPolyhedraIsCertified) {
  Random random;
  for (int trial = 0; trial < 300; ++trial) {
    const double size = std::pow(10.0, random.between(-3, 0));
    const Hull a = roundHull(random, 8 + trial % 60, size),
               b = boxHull(size * (random.inCube(1).cwiseAbs() + Vec3(0.1, 0.1, 0.1)));
    Pair pair(a, b);
    const Pose X_A{random.inCube(1), random.turn()},
        X_B{X_A.p + size * random.between(2, 4) * random.inCube(1).normalized(), random.turn()};
    const ConvexDistance found = pair.at(X_A, X_B);
    if (found.kind == Kind::kOverlap) continue;
    expectCertified(pair, found, 1e-12, trial);
  }
}

// Skins of micrometres between solids of centimetres: the direction must hold there.
TEST(ConvexDistance, KeepsItsDirectionAcrossAMicrometre) {
  Random random;
  for (int trial = 0; trial < 300; ++trial) {
    const Hull a = roundHull(random, 60, 0.02), b = roundHull(random, 200, 0.03);
    Pair pair(a, b);
    const Pose X_A{random.inCube(1), random.turn()};
    Pose X_B{X_A.p + 0.08 * random.inCube(1).normalized(), random.turn()};
    const ConvexDistance far = pair.at(X_A, X_B);
    ASSERT_EQ(far.kind, Kind::kNearest);
    const double skin = std::pow(10.0, random.between(-8, -5));
    X_B.p -= (far.gap - skin) * far.nhat_AB;
    const ConvexDistance near = pair.at(X_A, X_B);
    ASSERT_EQ(near.kind, Kind::kNearest) << trial;
    EXPECT_NEAR(near.gap, skin, 1e-13) << trial;
    EXPECT_NEAR(pair.planeGap(near.nhat_AB), skin, 1e-4 * skin + 1e-13) << trial;
    EXPECT_GT(near.nhat_AB.dot(far.nhat_AB), 1 - 1e-8) << trial;
  }
}

// A cylinder is round: its iterations end within 1e-8 of the distance.
TEST(ConvexDistance, OfRoundSolidsIsCertified) {
  Random random;
  const std::vector<Hull> solids{sphereHull(0.02), capsuleHull(0.01, 0.05), cylinderHull(0.02, 0.06),
                                 boxHull({0.02, 0.05, 0.03})};
  for (int trial = 0; trial < 400; ++trial) {
    Pair pair(solids[static_cast<std::size_t>(trial) % 4], solids[static_cast<std::size_t>(trial / 4) % 4]);
    const Pose X_A{random.inCube(0.1), random.turn()},
        X_B{X_A.p + random.between(0.07, 0.12) * random.inCube(1).normalized(), random.turn()};
    const ConvexDistance found = pair.at(X_A, X_B);
    if (found.kind == Kind::kOverlap) continue;
    if (found.gap <= 0) continue;
    expectCertified(pair, found, 2e-8 * (found.gap + 0.03), trial);
  }
}

TEST(ConvexDistance, SpheresThatOverlapByTheirRadiiHaveADepth) {
  Pair pair(sphereHull(0.02), sphereHull(0.03));
  const ConvexDistance found = pair.at({}, {{0.04, 0, 0}, Quat::Identity()});
  EXPECT_EQ(found.kind, Kind::kNearest);
  EXPECT_NEAR(found.gap, -0.01, 1e-15);
  EXPECT_NEAR(found.nhat_AB.x(), 1, 1e-15);
}

TEST(ConvexDistance, StopsBeyondTheRange) {
  Pair pair(boxHull({1, 1, 1}), boxHull({1, 1, 1}));
  const ConvexDistance found = pair.at({}, {{3, 0.2, 0}, Quat::Identity()}, 0.5);
  EXPECT_EQ(found.kind, Kind::kBeyond);
  EXPECT_GT(found.gap, 0.5);
  EXPECT_LE(found.gap, 2);
  EXPECT_NEAR(pair.planeGap(found.nhat_AB), found.gap, 1e-12);
}

TEST(ConvexDistance, OverlapHasTheFaceOfLeastDepth) {
  Pair pair(boxHull({1, 1, 1}), boxHull({0.2, 0.2, 0.2}));
  EXPECT_EQ(pair.at({}, {{0.1, 0.57, -0.2}, Quat::Identity()}).kind, Kind::kOverlap);
  const SupportingPlane face = pair.face();
  EXPECT_NEAR(face.gap, -0.03, 1e-12);
  EXPECT_NEAR(face.nhat_AB.y(), 1, 1e-12);
}

// The middle of a merged face is in no edge: a search along the edges must not begin there.
TEST(SupportOf, PassesOverPointsWithinFaces) {
  TriMesh mesh = makeCylinder(0.02, 0.04);
  Hull hull = meshHull(mesh, 1e-5, 2000).value();
  hull.vertices.insert(hull.vertices.begin(), Vec3(0, 0, 0.02));  // of no face
  for (Hull::Face& face : hull.faces) {
    for (std::int32_t& v : face.loop) ++v;
  }
  for (Hull::Edge& edge : hull.edges) {
    ++edge.from;
    ++edge.to;
  }
  const SupportOf support(hull);
  Random random;
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 d = random.inCube(1);
    double farthest = -1;
    for (const Vec3& v : mesh.vertices) farthest = std::max(farthest, d.dot(v));
    std::int32_t near = 0;
    EXPECT_NEAR(support(d, near).dot(d), farthest, 1e-12) << trial;
  }
}

// The memory of a moving pair changes the way to the answer, not the answer.
TEST(ConvexDistance, WithItsMemoryIsAsWithout) {
  Random random;
  const Hull a = roundHull(random, 200, 0.03), b = cylinderHull(0.01, 0.05);
  Pair remembers(a, b);
  for (int i = 0; i < 500; ++i) {
    const double angle = 0.02 * i;
    const Pose X_B{{0.05 * std::cos(angle), 0.05 * std::sin(angle), 0.01 * std::sin(3 * angle)},
                   Quat(Eigen::AngleAxisd(2 * angle, Vec3(1, 2, 3).normalized()))};
    Pair forgets(a, b);
    EXPECT_NEAR(remembers.at({}, X_B).gap, forgets.at({}, X_B).gap, 1e-9) << i;
  }
}

}  // namespace
}  // namespace presa
