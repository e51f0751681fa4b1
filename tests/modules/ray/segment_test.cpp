// Distances of a segment against searches that leave nothing out.
#include "modules/ray/segment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "modules/ray/segment_front.h"

namespace presa::segment_test {
namespace {

/// Random vectors of about this length.
struct Dice {
  std::mt19937 engine{7};
  Vec3 operator()(double size) {
    std::normal_distribution<double> normal;
    return size * Vec3(normal(engine), normal(engine), normal(engine));
  }
};

/// Distance of a segment and a triangle by golden section: the distance of a point is convex along the segment.
double searched(const Segment& segment, const PreparedTriangle& t) {
  double low = 0, high = 1;
  const auto at = [&](double s) { return (segment.at(s) - closestOnTriangle(segment.at(s), t)).norm(); };
  for (int i = 0; i < 200; ++i) {
    const double a = low + 0.382 * (high - low), b = low + 0.618 * (high - low);
    (at(a) < at(b) ? high : low) = at(a) < at(b) ? b : a;
  }
  return std::min({at(low), at(0), at(1)});
}

TEST(Segment, IsAsFarFromATriangleAsASearchSays) {
  Dice dice;
  int through = 0;
  for (int i = 0; i < 20'000; ++i) {
    const double flat = i % 3 == 0 ? 1e-3 : 1;
    const PreparedTriangle t(dice(1), dice(1), i % 5 == 0 ? Vec3(dice(1e-3)) : dice(1));
    const Segment segment{flat * dice(1), i % 4 == 0 ? Vec3(dice(0.1)) : dice(2)};
    const SegmentNearest found = nearest(segment, t);
    EXPECT_NEAR(found.distance, searched(segment, t), 2e-7) << i;
    through += found.where == SegmentNearest::Where::kCrossing;
    if (!(found.distance > 1e-6)) continue;
    EXPECT_NEAR((segment.at(found.s) - found.on_body - found.distance * found.nhat).norm(), 0, 1e-12) << i;
    // the plane between them: all of the segment beyond it, all of the triangle before it
    const double plane = found.nhat.dot(found.on_body);
    for (const Vec3& corner : {t.a, t.b, t.c}) EXPECT_LT(found.nhat.dot(corner) - plane, 1e-7) << i;
    for (const Vec3& end : {segment.a, segment.b}) EXPECT_GT(found.nhat.dot(end) - plane, found.distance - 1e-7) << i;
  }
  EXPECT_GT(through, 500);
}

// A segment wanders around a mesh and through it, at different speeds.
TEST(Segment, FrontFindsTheNearestTriangle) {
  const auto mesh = std::make_shared<const TriMesh>(makeSphere(0.05, 4));
  const MeshTree tree(mesh);
  Dice dice;
  SegmentFront front;
  front.seed(tree);
  Segment segment{{0.06, -0.05, 0.01}, {0.06, 0.05, 0}};
  int found_near = 0;
  for (int i = 0; i < 6000; ++i) {
    const double speed = i % 1000 < 800 ? 1e-4 : 4e-3;
    segment.a += dice(speed) - 2e-3 * speed / 1e-4 * (segment.a - Vec3(0.055, -0.05, 0));
    segment.b += dice(speed) - 2e-3 * speed / 1e-4 * (segment.b - Vec3(0.045, 0.05, 0));
    const double reach = 0.005;
    front.focus(segment, reach, i % 2 == 0 ? 0 : 1e-3);
    for (int look = 0; look < 3; ++look) {
      const Segment moved{segment.a + dice(1e-4), segment.b + dice(1e-4)};
      const SegmentFront::Found found = front.nearestOf(moved, reach - 1e-3);
      double least = 1e300;
      for (std::int32_t f = 0; f < static_cast<std::int32_t>(mesh->triangles.size()); ++f) {
        const MeshTree::Facet& facet = tree.facet(f);
        const PreparedTriangle t(tree.corner(facet, 0), tree.corner(facet, 1), tree.corner(facet, 2));
        if (i % 20 == 0) least = std::min(least, nearest(moved, t).distance);
      }
      if (i % 20 != 0) continue;
      if (least < reach - 1e-3) {
        ++found_near;
        ASSERT_NE(found.ref, SegmentFront::kNothing) << i;
        EXPECT_GE(found.at.distance, least) << i;
        EXPECT_LE(found.at.distance, least + SegmentFront::kSlack) << i;
      } else {
        EXPECT_EQ(found.ref, SegmentFront::kNothing) << i;
      }
    }
  }
  EXPECT_GT(found_near, 200);
  EXPECT_FALSE(front.full());
}

}  // namespace
}  // namespace presa::segment_test
