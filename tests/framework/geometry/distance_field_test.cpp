// Distance fields against closed forms, and against the exact distance of their mesh.
#include "framework/geometry/distance_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "framework/core/math/random.h"
#include "framework/geometry/mesh_distance.h"
#include "tests/support/effort.h"

namespace presa::distance_field_test {
namespace {

constexpr double kVoxel = 0.001;

double sphere(const Vec3& p) { return p.norm() - 0.02; }
double box(const Vec3& p) {
  const Vec3 q = p.cwiseAbs() - Vec3(0.02, 0.015, 0.01);
  return q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0);
}
double torus(const Vec3& p) { return std::hypot(std::hypot(p.x(), p.y()) - 0.02, p.z()) - 0.008; }

DistanceField fieldOf(double (*exact)(const Vec3&), const DistanceField::Settings& settings = {.voxel = kVoxel}) {
  return *DistanceField::build([&](const Vec3& p, double) { return exact(p); },
                               {Vec3::Constant(-0.03), Vec3::Constant(0.03)}, settings);
}

Vec3 somewhere(RandomStream& random, double reach) {
  return {random.uniform(-reach, reach), random.uniform(-reach, reach), random.uniform(-reach, reach)};
}

TriMesh torusMesh(int around, int along) {
  TriMesh mesh;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < along; ++j) {
      const double a = 2 * std::numbers::pi * i / around, b = 2 * std::numbers::pi * j / along;
      const double r = 0.02 + 0.008 * std::cos(b);
      mesh.vertices.emplace_back(r * std::cos(a), r * std::sin(a), 0.008 * std::sin(b));
      const int next_i = (i + 1) % around, next_j = (j + 1) % along;
      const auto at = [&](int x, int y) { return x * along + y; };
      mesh.triangles.push_back({at(i, j), at(next_i, j), at(next_i, next_j)});
      mesh.triangles.push_back({at(i, j), at(next_i, next_j), at(i, next_j)});
    }
  }
  buildAdjacency(mesh);
  return mesh;
}

// Trilinear interpolation errs by h^2 / 8 times the curvature along each axis: 2 x 1 mm^2 / (8 x 20 mm) on the sphere,
// up to three times as much at the torus's inner side of 8 mm.
TEST(DistanceField, OfSmoothSolidsIsRightToATenthOfAVoxelInTheNarrowBand) {
  for (const auto exact : {sphere, torus}) {
    const DistanceField field = fieldOf(exact);
    RandomStream random(1, "field");
    int looked = 0;
    for (int i = 0; i < 200000; ++i) {
      const Vec3 p = somewhere(random, 0.03);
      if (std::abs(exact(p)) > 3 * kVoxel) continue;
      ++looked;
      ASSERT_NEAR(field.at(p), exact(p), 0.1 * kVoxel) << p.transpose();
    }
    EXPECT_GT(looked, 5000);
  }
}

// Half the voxel, a quarter of the error: interpolation is of second order.
TEST(DistanceField, ConvergesWithTheSquareOfTheVoxel) {
  double last = 0;
  for (const double voxel : {0.002, 0.001, 0.0005}) {
    const DistanceField field = fieldOf(torus, {.voxel = voxel});
    RandomStream random(8, "field");
    double squares = 0;
    int looked = 0;
    while (looked < 20000) {
      const Vec3 p = somewhere(random, 0.03);
      if (std::abs(torus(p)) > 0.001) continue;
      squares += std::pow(field.at(p) - torus(p), 2);
      ++looked;
    }
    const double error = std::sqrt(squares / looked);
    if (last > 0) {
      EXPECT_NEAR(std::log2(last / error), 2, 0.2) << voxel;
    }
    last = error;
  }
}

// Inside of a box the distance has ridges, outside it is round at edges; elsewhere it is linear, hence exact.
TEST(DistanceField, OfABoxIsExactUnderItsFaces) {
  const DistanceField field = fieldOf(box);
  RandomStream random(2, "field");
  for (int i = 0; i < 20000; ++i) {
    const Vec3 p(random.uniform(-0.012, 0.012), random.uniform(-0.009, 0.009), random.uniform(0.0085, 0.013));
    ASSERT_NEAR(field.at(p), box(p), 1e-4 * kVoxel) << p.transpose();
    ASSERT_NEAR((field.gradient(p) - Vec3::UnitZ()).norm(), 0, 1e-3);
  }
}

TEST(DistanceField, IsContinuousAcrossVoxelsAndBlocksOfTheBand) {
  const DistanceField field = fieldOf(torus);
  RandomStream random(3, "field");
  const double step = 1e-4 * kVoxel;
  for (int i = 0; i < 200000; ++i) {
    const Vec3 p = somewhere(random, 0.03);
    if (std::abs(torus(p)) > 2 * kVoxel) continue;
    const Vec3 on_border = field.origin() + kVoxel * ((p - field.origin()) / kVoxel).array().round().matrix();
    const Vec3 before = p + (on_border.x() - p.x() - step) * Vec3::UnitX(), after = before + 2 * step * Vec3::UnitX();
    ASSERT_NEAR(field.at(before), field.at(after), 4 * step);
  }
}

TEST(DistanceField, NeverPromisesMoreRoomThanThereIs) {
  for (const auto exact : {sphere, box, torus}) {
    const DistanceField field = fieldOf(exact);
    RandomStream random(4, "field");
    for (int i = 0; i < 100000; ++i) {
      const Vec3 p = somewhere(random, 0.06);
      ASSERT_LE(field.lowerBound(p), exact(p) + 1e-7) << p.transpose();
    }
  }
}

TEST(DistanceField, OfAMeshHasTheMeshsSignAndDistance) {
  const TriMesh mesh = torusMesh(48, 24);
  const MeshDistance distance(mesh);
  const auto field = DistanceField::build([&](const Vec3& p, double bound) { return distance(p, bound); },
                                          boundsOf(mesh), {.voxel = kVoxel});
  ASSERT_TRUE(field);
  RandomStream random(5, "field");
  int inside = 0;
  for (int i = 0; i < 50000; ++i) {
    const Vec3 p = somewhere(random, 0.03);
    const double exact = distance(p), chord = 0.028 * (1 - std::cos(std::numbers::pi / 24));
    ASSERT_NEAR(exact, torus(p), 1.2 * chord) << p.transpose();
    if (std::abs(exact) < 3 * kVoxel) {
      ASSERT_NEAR(field->at(p), exact, 0.15 * kVoxel) << p.transpose();
    }
    inside += field->at(p) < 0;
  }
  EXPECT_NEAR(inside / 50000.0, 2 * std::numbers::pi * std::numbers::pi * 0.02 * 0.008 * 0.008 / std::pow(0.06, 3),
              0.01);
}

// At corners and edges the nearest triangles are at a tie, and the face normals of some of them point the wrong way.
TEST(MeshDistance, KnowsInsideFromOutsideAtSharpEdges) {
  TriMesh mesh = makeBox({0.04, 0.03, 0.02});
  buildAdjacency(mesh);
  const MeshDistance distance(mesh);
  RandomStream random(6, "field");
  for (int i = 0; i < 100000; ++i) {
    const Vec3 p = somewhere(random, 0.03);
    ASSERT_NEAR(distance(p), box(p), 1e-12) << p.transpose();
    ASSERT_NEAR(distance(p, std::abs(box(p)) + 1e-6), box(p), 1e-12);
    ASSERT_NEAR(distance(p, 1e-9), box(p), 1e-12) << "a bound that is too small";
  }
}

TEST(DistanceField, AboveItsMemoryIsRefusedBeforeItIsBuilt) {
  int asked = 0;
  DistanceField::Size size;
  const auto count = [&](const Vec3& p, double) { return ++asked, sphere(p); };
  const AxisBox bounds{Vec3::Constant(-0.03), Vec3::Constant(0.03)};
  EXPECT_FALSE(DistanceField::build(count, bounds, {.voxel = kVoxel, .max_bytes = 1 << 19U}, &size));
  EXPECT_GT(size.bytes, std::size_t{1} << 19U);
  EXPECT_LT(asked, 4000) << "corners and centres of blocks only";
  asked = 0;
  EXPECT_FALSE(DistanceField::build(count, bounds, {.voxel = 1e-9}, &size));
  EXPECT_EQ(asked, 0) << "not even those of a grid without end";
}

TEST(DistanceField, StopsWhenItIsTold) {
  EXPECT_FALSE(DistanceField::build([](const Vec3& p, double) { return sphere(p); },
                                    {Vec3::Constant(-0.03), Vec3::Constant(0.03)},
                                    {.voxel = 0.0003, .go_on = [](double done) { return done < 0.3; }}));
}

TEST(DistanceField, ComesBackFromItsBytesAndSeesDamage) {
  const DistanceField field = fieldOf(torus);
  const std::string bytes = field.bytes();
  const auto again = DistanceField::fromBytes(bytes);
  ASSERT_TRUE(again);
  RandomStream random(7, "field");
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p = somewhere(random, 0.04);
    EXPECT_EQ(again->at(p), field.at(p));
  }
  for (const std::size_t length : {std::size_t{0}, std::size_t{7}, std::size_t{60}, bytes.size() - 1})
    EXPECT_FALSE(DistanceField::fromBytes(bytes.substr(0, length))) << length;
  for (int i = 0; i < unlessSanitized(2000, 300); ++i) {  // whatever it says, it stays within its memory
    std::string broken = bytes;
    broken[random.below(200)] = static_cast<char>(random.bits());
    if (const auto read = DistanceField::fromBytes(broken)) read->at(somewhere(random, 0.04));
  }
}

}  // namespace
}  // namespace presa::distance_field_test
