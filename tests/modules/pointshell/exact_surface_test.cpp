// Points of round tools lie on the surface itself, not on the facets of its triangles.
#include "modules/pointshell/exact_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace presa::exact_surface_test {
namespace {

const Pose kPlaced{{0.03, -0.01, 0.02}, Quat(0.5, 0.1, -0.7, 0.5).normalized()};  // in the handle

Geometry placed(const Shape& shape) { return {.shape = shape, .X_BG = kPlaced, .where = {}}; }

/// Of a tool of this shape and mesh: places and normals in the frame of the shape.
template <class Look>
void forEachPoint(const Shape& shape, TriMesh mesh, Look look) {
  for (Vec3& v : mesh.vertices) v = kPlaced * v;
  buildAdjacency(mesh);
  const PointShell shell(mesh, 1e-9, 20000, exactSurfaceOf(placed(shape)));
  ASSERT_GT(shell.size(), 10000U);
  for (std::size_t i = 0; i < shell.size(); ++i) {
    EXPECT_LE(static_cast<double>(shell.points()[i].norm()), shell.radius());
    look(kPlaced.inverseTimes(shell.points()[i].cast<double>()),
         Vec3(kPlaced.q.conjugate() * shell.normals()[i].cast<double>()));
  }
}

// Tolerance: single precision of places up to 60 mm from the handle.
constexpr double kPlace = 1e-8, kNormal = 1e-6;

TEST(ExactSurface, OfABallHasItsRadiusAndItsNormals) {
  forEachPoint(Sphere{0.02}, makeSphere(0.02), [](const Vec3& p, const Vec3& normal) {
    ASSERT_NEAR(p.norm(), 0.02, kPlace);
    ASSERT_LT((normal - p / 0.02).norm(), kNormal);
  });
}

TEST(ExactSurface, OfACapsuleIsRoundAlongItsAxisAndAtItsEnds) {
  forEachPoint(Capsule{0.01, 0.04}, makeCapsule(0.01, 0.04), [](const Vec3& p, const Vec3& normal) {
    const Vec3 on_axis(0, 0, std::clamp(p.z(), -0.02, 0.02));
    ASSERT_NEAR((p - on_axis).norm(), 0.01, kPlace);
    ASSERT_LT((normal - (p - on_axis) / 0.01).norm(), kNormal);
  });
}

TEST(ExactSurface, OfACylinderHasFlatEndsAndARoundEdge) {
  int on_edge = 0, on_end = 0;
  forEachPoint(Cylinder{0.01, 0.04}, makeCylinder(0.01, 0.04), [&](const Vec3& p, const Vec3& normal) {
    const double across = normal.head<2>().norm(), from_axis = p.head<2>().norm();
    if (across < 0.1) {
      ++on_end;
      ASSERT_NEAR(std::abs(p.z()), 0.02, kPlace);
      ASSERT_LT(from_axis, 0.01 + kPlace);
      return;
    }
    if (std::abs(std::abs(p.z()) - 0.02) < 10 * kPlace) ++on_edge;
    ASSERT_NEAR(from_axis, 0.01, kPlace);
    ASSERT_LT((normal.head<2>() / across - p.head<2>() / from_axis).norm(), kNormal);
  });
  EXPECT_GT(on_end, 1000);
  EXPECT_GT(on_edge, 100) << "of 192 corners of the edges; points of the faces crowd some out";
}

TEST(ExactSurface, OfABoxIsItsTriangles) { EXPECT_FALSE(exactSurfaceOf(placed(Box{{0.01, 0.02, 0.03}}))); }

}  // namespace
}  // namespace presa::exact_surface_test
