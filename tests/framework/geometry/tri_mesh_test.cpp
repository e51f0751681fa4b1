#include "framework/geometry/tri_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "framework/geometry/closest_point.h"

namespace presa {
namespace {

using std::numbers::pi;

TriMesh soupOf(const TriMesh& mesh) {
  TriMesh soup;
  for (const auto& triangle : mesh.triangles) {
    const auto base = static_cast<std::int32_t>(soup.vertices.size());
    for (const std::int32_t index : triangle) soup.vertices.push_back(mesh.vertices[static_cast<std::size_t>(index)]);
    soup.triangles.push_back({base, base + 1, base + 2});
  }
  return soup;
}

TriMesh moved(TriMesh mesh, const Pose& X) {
  for (Vec3& vertex : mesh.vertices) vertex = X * vertex;
  return mesh;
}

Pose somePose() { return {Vec3(0.3, -2.0, 0.7), Quat(Eigen::AngleAxisd(1.1, Vec3(1, -2, 3).normalized()))}; }

void expectSound(const TriMesh& mesh) {
  const MeshReport report = checkMesh(mesh);
  EXPECT_EQ(report.non_finite + report.bad_index + report.degenerate + report.non_manifold + report.open_edges +
                report.flipped_edges,
            0u);
  EXPECT_FALSE(report.inverted);
  EXPECT_GT(massProperties(mesh).volume, 0);
}

// The framework's own primitives pass the checks demanded of users, and round shapes are round.
TEST(Primitives, AreClosedConsistentAndRound) {
  expectSound(makeBox({1, 2, 3}));
  expectSound(makeSphere(0.03));
  expectSound(makeCylinder(0.03, 0.1));
  expectSound(makeCapsule(0.03, 0.1));
  expectSound(makeCapsule(0.03, 0.0));
  // chord error: the header states 0.12 % of the radius; measured at the centre of each triangle, where it is largest
  const auto worstChord = [](const TriMesh& mesh, auto distance) {
    double worst = 0;
    for (const auto& t : mesh.triangles) {
      const Vec3 a = mesh.vertices[static_cast<std::size_t>(t[0])], b = mesh.vertices[static_cast<std::size_t>(t[1])],
                 c = mesh.vertices[static_cast<std::size_t>(t[2])];
      for (const Vec3& p : {Vec3((a + b + c) / 3), Vec3((a + b) / 2), Vec3((b + c) / 2), Vec3((c + a) / 2)}) {
        worst = std::max(worst, 1 - distance(p));
      }
    }
    return worst;
  };
  EXPECT_LT(worstChord(makeSphere(1), [](const Vec3& p) { return p.norm(); }), 1.2e-3);
  EXPECT_LT(worstChord(makeCapsule(1, 2),
                       [](const Vec3& p) { return (p - Vec3(0, 0, std::clamp(p.z(), -1.0, 1.0))).norm(); }),
            1.2e-3);
}

// A box is bounded by planes, so the divergence theorem must reproduce the closed form to rounding, wherever it lies.
TEST(MassProperties, OfABoxAreTheClosedFormAnywhere) {
  const Vec3 size(0.2, 0.5, 0.9);
  const Pose X = somePose();
  const MassProperties result = massProperties(moved(makeBox(size), X));
  const double volume = size.prod();
  const Mat3 R = X.q.toRotationMatrix();
  const Vec3 moments = volume / 12 * Vec3(0.25 + 0.81, 0.04 + 0.81, 0.04 + 0.25);
  EXPECT_NEAR(result.volume, volume, 1e-14);
  EXPECT_LT((result.center - X.p).norm(), 1e-14);
  EXPECT_LT((result.inertia - R * moments.asDiagonal() * R.transpose()).norm(), 1e-15);
}

// A polyhedron inscribed in a sphere lacks a part that quarters with each subdivision: second-order convergence
// to 4/3 pi r^3 and 2/5 V r^2 shows that volume and inertia have the right limit.
TEST(MassProperties, OfASphereConvergeWithSecondOrder) {
  const double r = 0.04, volume = 4.0 / 3 * pi * r * r * r, inertia = 0.4 * volume * r * r;
  double previous_volume = 0, previous_inertia = 0;
  for (int level = 2; level <= 5; ++level) {
    const MassProperties result = massProperties(makeSphere(r, level));
    const double volume_error = 1 - result.volume / volume, inertia_error = 1 - result.inertia(0, 0) / inertia;
    if (level > 2) {
      EXPECT_NEAR(previous_volume / volume_error, 4, 0.2);  // 5 %: the next term of the series at level 2
      EXPECT_NEAR(previous_inertia / inertia_error, 4, 0.2);
    }
    previous_volume = volume_error;
    previous_inertia = inertia_error;
  }
}

// A right prism has exact formulas for any number of segments: area n/2 r^2 sin(2 pi/n).
TEST(MassProperties, OfAPrismAreTheClosedForm) {
  const double r = 0.03, length = 0.11;
  const int n = 7;
  const double s = std::sin(2 * pi / n), c = std::cos(2 * pi / n);
  const double volume = n / 2.0 * r * r * s * length;
  const double axial = volume * r * r * (2 + c) / 6;
  const MassProperties result = massProperties(makeCylinder(r, length, n));
  EXPECT_NEAR(result.volume, volume, 1e-15 * volume * 100);
  EXPECT_NEAR(result.inertia(2, 2), axial, 1e-12 * axial);
  EXPECT_NEAR(result.inertia(0, 0), axial / 2 + volume * length * length / 12, 1e-12 * axial);
}

TEST(MassProperties, OfAMeshInsideOutHaveNegativeVolume) {
  TriMesh mesh = makeBox({1, 1, 1});
  turnInsideOut(mesh);
  EXPECT_NEAR(massProperties(mesh).volume, -1, 1e-15);
  EXPECT_TRUE(checkMesh(mesh).inverted);
}

// Soup of three independent corners per triangle, each displaced by less than half the tolerance, must weld back to the
// original mesh: same counts, closed again.
TEST(Weld, RestoresAMeshFromSoupInSpiteOfNoise) {
  const TriMesh sphere = makeSphere(0.05, 4);
  TriMesh soup = soupOf(sphere);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> noise(-1, 1);
  const double tolerance = 1e-7;
  for (Vec3& vertex : soup.vertices)
    vertex += 0.49 * tolerance * Vec3(noise(random), noise(random), noise(random)) / std::sqrt(3.0);
  EXPECT_EQ(weld(soup, tolerance), 3 * sphere.triangles.size() - sphere.vertices.size());
  EXPECT_EQ(soup.vertices.size(), sphere.vertices.size());
  EXPECT_EQ(soup.triangles.size(), sphere.triangles.size());
  expectSound(soup);
}

// Cells are as wide as the tolerance, so a pair may straddle any cell border: brute force over all pairs is the oracle.
TEST(Weld, KeptVerticesAreApartAndNoVertexMovesFartherThanTheTolerance) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  TriMesh mesh;
  for (int i = 0; i < 600; ++i) mesh.vertices.emplace_back(uniform(random), uniform(random), uniform(random));
  for (std::int32_t i = 0; i < 600; i += 3) mesh.triangles.push_back({i, i + 1, i + 2});
  const TriMesh before = mesh;
  const double tolerance = 0.1;
  const std::size_t removed = weld(mesh, tolerance);
  EXPECT_GT(removed, 100u);
  EXPECT_EQ(before.vertices.size() - removed, mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_GT((mesh.vertices[i] - mesh.vertices[j]).norm(), tolerance);
  }
  for (const Vec3& vertex : before.vertices) {
    double nearest = 1e9;
    for (const Vec3& kept : mesh.vertices) nearest = std::min(nearest, (kept - vertex).norm());
    EXPECT_LE(nearest, tolerance);
  }
}

TEST(Weld, WithZeroToleranceMergesEqualVerticesOnly) {
  TriMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0, std::nextafter(1.0, 2.0), 0}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  EXPECT_EQ(weld(mesh, 0), 2u);
}

TEST(Weld, DropsTrianglesThatCollapse) {
  TriMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1e-9, 0, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}};
  EXPECT_EQ(weld(mesh, 1e-6), 1u);
  EXPECT_EQ(mesh.triangles.size(), 1u);
}

TEST(Adjacency, IsMutualAndSharesTheEdge) {
  const TriMesh mesh = makeCapsule(0.02, 0.05);
  ASSERT_EQ(mesh.adjacency.size(), mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t e = 0; e < 3; ++e) {
      const std::int32_t n = mesh.adjacency[t][e];
      ASSERT_GE(n, 0);
      const auto& other = mesh.triangles[static_cast<std::size_t>(n)];
      const std::set<std::int32_t> corners(other.begin(), other.end());
      EXPECT_TRUE(corners.contains(mesh.triangles[t][e]) && corners.contains(mesh.triangles[t][(e + 1) % 3]));
      const auto& back = mesh.adjacency[static_cast<std::size_t>(n)];
      EXPECT_EQ(std::count(back.begin(), back.end(), static_cast<std::int32_t>(t)), 1);
    }
  }
}

TEST(Adjacency, SurvivesTurningInsideOut) {
  TriMesh turned = makeBox({1, 2, 3});
  turnInsideOut(turned);
  const auto adjacency = turned.adjacency;
  buildAdjacency(turned);
  EXPECT_EQ(adjacency, turned.adjacency);
}

// Each defect is counted once, under its own name only.
TEST(CheckMesh, NamesEachDefectOnce) {
  const TriMesh good = makeBox({1, 1, 1});
  TriMesh open = good;
  open.triangles.pop_back();
  EXPECT_EQ(checkMesh(open).open_edges, 3u);
  buildAdjacency(open);
  EXPECT_EQ(std::count_if(open.adjacency.begin(), open.adjacency.end(),
                          [](const auto& a) { return std::count(a.begin(), a.end(), -1) > 0; }),
            3);

  TriMesh flipped = good;
  std::swap(flipped.triangles[0][0], flipped.triangles[0][1]);
  EXPECT_EQ(checkMesh(flipped).flipped_edges, 3u);

  TriMesh fin = good;
  fin.vertices.emplace_back(5, 5, 5);
  fin.triangles.push_back({0, 1, 8});
  EXPECT_EQ(checkMesh(fin).non_manifold, 1u);
  EXPECT_EQ(checkMesh(fin).open_edges, 2u);

  TriMesh wrong = good;
  wrong.triangles[2][1] = 8;
  wrong.triangles[3][1] = -1;
  EXPECT_EQ(checkMesh(wrong).bad_index, 2u);

  TriMesh infinite = good;
  infinite.vertices[3].y() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(checkMesh(infinite).non_finite, 1u);

  TriMesh flat = good;
  flat.vertices.emplace_back(0.25 * good.vertices[0] + 0.75 * good.vertices[1]);
  flat.triangles.push_back({0, 1, 8});
  EXPECT_EQ(checkMesh(flat).degenerate, 1u);
}

// "Degenerate" depends on shape only: the same sliver in metres, millimetres or micrometres.
TEST(CheckMesh, JudgesSliversWithoutScale) {
  for (const double scale : {1e-6, 1e-3, 1.0, 1e3}) {
    TriMesh mesh;
    mesh.vertices = {{0, 0, 0}, {scale, 0, 0}, {0.5 * scale, 1e-5 * scale, 0}, {0.5 * scale, 1e-9 * scale, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 1, 3}};
    EXPECT_EQ(checkMesh(mesh).degenerate, 1u) << scale;
  }
}

/// Independent oracle: the distance to a triangle is convex in barycentric coordinates, so shrinking grids find it.
double gridDistance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  double u0 = 1.0 / 3, v0 = 1.0 / 3, width = 1, best = 1e300;
  for (int round = 0; round < 60; ++round) {
    double best_u = u0, best_v = v0;
    for (int i = -4; i <= 4; ++i) {
      for (int j = -4; j <= 4; ++j) {
        const double u = std::clamp(u0 + width * i / 4, 0.0, 1.0), v = std::clamp(v0 + width * j / 4, 0.0, 1.0 - u);
        const double d = (a + u * (b - a) + v * (c - a) - p).norm();
        if (d < best) best = d, best_u = u, best_v = v;
      }
    }
    u0 = best_u;
    v0 = best_v;
    width *= 0.7;
  }
  return best;
}

TEST(ClosestPoint, AgreesWithAnIndependentMinimisationInEveryRegion) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  const auto point = [&] { return Vec3(normal(random), normal(random), normal(random)); };
  for (int i = 0; i < 300; ++i) {
    const Vec3 a = point(), b = point(), c = point(), p = 2 * point();
    const double distance = (p - closestOnTriangle(p, a, b, c)).norm();
    EXPECT_NEAR(distance, gridDistance(p, a, b, c), 1e-6);  // resolution of the oracle's last grids
  }
}

// Corner, edge and face answers of one triangle, worked out by hand.
TEST(ClosestPoint, IsExactOnCornersEdgesAndFace) {
  const Vec3 a(0, 0, 0), b(4, 0, 0), c(0, 3, 0);
  EXPECT_EQ(closestOnTriangle({-1, -1, 2}, a, b, c), a);
  EXPECT_EQ(closestOnTriangle({9, -1, 0}, a, b, c), b);
  EXPECT_EQ(closestOnTriangle({1, -2, 5}, a, b, c), Vec3(1, 0, 0));
  EXPECT_LT((closestOnTriangle({1, 1, -7}, a, b, c) - Vec3(1, 1, 0)).norm(), 1e-15);
  EXPECT_LT((closestOnTriangle({2 + 3, 1.5 + 4, 1}, a, b, c) - Vec3(2, 1.5, 0)).norm(), 1e-15);
}

// In a sliver of any flatness the closest point lies in the triangle, no farther from p than the nearest corner or
// edge.
TEST(ClosestPoint, StaysInSlivers) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (double height = 1; height > 1e-18; height *= 0.1) {
    const Vec3 a(0, 0, 0), b(1, 0, 0), c(0.4, height, 0);
    for (int i = 0; i < 20; ++i) {
      const Vec3 p(uniform(random), uniform(random), uniform(random));
      const Vec3 q = closestOnTriangle(p, a, b, c);
      EXPECT_TRUE(q.x() >= 0 && q.x() <= 1 && q.y() >= 0 && q.y() <= height && q.z() == 0);
      EXPECT_LE((p - q).norm(), (p - closestOnSegment(p, a, b)).norm() * (1 + 1e-15));
      if (height < 1e-9) {
        EXPECT_NEAR((p - q).norm(), (p - closestOnSegment(p, a, b)).norm(), 2 * height + 1e-15);
      }
    }
  }
}

// Scaling the input scales the answer; powers of two exactly, to the bit.
TEST(ClosestPoint, HasNoScale) {
  const Vec3 a(0.1, 0.2, 0.3), b(0.7, -0.1, 0.4), c(0.2, 0.9, -0.5), p(0.5, 0.6, 0.9);
  const Vec3 q = closestOnTriangle(p, a, b, c);
  for (const double scale : {std::ldexp(1.0, -40), 1.0 / 1024, 65536.0}) {
    EXPECT_EQ(closestOnTriangle(scale * p, scale * a, scale * b, scale * c), scale * q);
  }
}

}  // namespace
}  // namespace presa
