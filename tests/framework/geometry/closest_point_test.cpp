#include "framework/geometry/closest_point.h"

#include <gtest/gtest.h>

#include <limits>

#include "framework/core/math/random.h"

namespace presa {
namespace {

using Long = Eigen::Matrix<long double, 3, 1>;

long double distanceToSegment(const Long& p, const Long& a, const Long& b) {
  const Long ab = b - a;
  const long double s = std::clamp(ab.dot(p - a) / ab.squaredNorm(), 0.0L, 1.0L);
  return (p - a - s * ab).norm();
}

/// The nearest of the three edges and of the face, in long double.
long double distanceToTriangle(const Long& p, const Long& a, const Long& b, const Long& c) {
  long double min = std::min({distanceToSegment(p, a, b), distanceToSegment(p, b, c), distanceToSegment(p, c, a)});
  const Long normal = (b - a).cross(c - a);
  const auto left = [&](const Long& from, const Long& to) { return normal.dot((to - from).cross(p - from)) >= 0; };
  if (left(a, b) && left(b, c) && left(c, a)) min = std::min(min, std::abs(normal.dot(p - a)) / normal.norm());
  return min;
}

Vec3 anyPoint(RandomStream& random) { return {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}; }

/// Difference between the distance found and the exact one.
double errorOf(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto exact =
      distanceToTriangle(p.cast<long double>(), a.cast<long double>(), b.cast<long double>(), c.cast<long double>());
  return std::abs((closestOnTriangle(p, a, b, c) - p).norm() - static_cast<double>(exact));
}

constexpr double kRounding = 64 * std::numeric_limits<double>::epsilon();  // of coordinates of one metre

// A triangle of about one metre with corners of these sines, and a point nearby, also beside its long edges.
TEST(ClosestPoint, OnNeedlesIsAsExactAsElsewhere) {
  RandomStream random(1, "needles");
  for (const double sine : {1.0, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9}) {
    double worst = 0;
    for (int i = 0; i < 100'000; ++i) {
      const Vec3 a = anyPoint(random), along = anyPoint(random).normalized();
      const Vec3 across = along.cross(anyPoint(random)).normalized();
      const Vec3 b = a + along, c = a + random.uniform(-0.1, 1.1) * along + sine * across;
      const Vec3 p = a + random.uniform(-0.2, 1.2) * along + 0.3 * anyPoint(random);
      worst = std::max(worst, errorOf(p, a, b, c));
    }
    EXPECT_LE(worst, kRounding) << "sine " << sine;
  }
}

// Two of a million needles (sines 3e-8 and 1e-10) for which the region test alone is off by 0.6 um and by 8 mm.
TEST(ClosestPoint, OnNeedlesThatMisleadTheRegionTest) {
  EXPECT_LE(errorOf({-0x1.bb97fca1f3e58p-3, -0x1.dd06321279a14p-1, -0x1.3fb488e3c97a8p-3},
                    {-0x1.78209976e35acp-2, -0x1.6d8409e315efep-1, -0x1.a799aaef79ed4p-3},
                    {0x1.ab2bb27bd4384p-2, -0x1.54e11d89c9341p+0, -0x1.0cced2582ba47p-2},
                    {-0x1.a987649a1e117p-2, -0x1.5a113e42f6b36p-1, -0x1.a096aaade1527p-3}),
            kRounding);
  EXPECT_LE(errorOf({0x1.9ffd74d73d88ap-3, 0x1.5dd3ccb75293p-4, 0x1.37c6315b5c662p-3},
                    {-0x1.3bc3ea344e79ap-2, 0x1.a1446951314ep-5, 0x1.c04865b1ce52p-2},
                    {0x1.05e6cd675fde7p-1, 0x1.390b3a772844cp-1, 0x1.48acd986e517p-2},
                    {0x1.41caca9de530ap-2, 0x1.e7fe3097af411p-2, 0x1.65744ebcfbf0dp-2}),
            kRounding);
}

}  // namespace
}  // namespace presa
