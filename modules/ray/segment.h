#pragma once
#include <array>

#include "framework/geometry/closest_point.h"

namespace presa {

/// The axis of a capsule.
struct Segment {
  Vec3 a = Vec3::Zero(),                                        ///< one end [m]
      b = Vec3::Zero();                                         ///< the other one
  Vec3 at(double s) const noexcept { return a + s * (b - a); }  ///< point at s, 0 to 1
};

/// The nearest points of a segment and a body.
struct SegmentNearest {
  /// Which parts of them these are.
  enum class Where { kEnd, kEdge, kCrossing };
  Vec3 nhat = Vec3::UnitZ();    ///< unit, body towards segment; crossing: the triangle's own normal
  double distance = 1e300;      ///< [m]; crossing: 0
  double s = 0;                 ///< of the segment
  Vec3 on_body = Vec3::Zero();  ///< nearest point
  Where where = Where::kEnd;    ///< an end of the segment, its inside at an edge, or it goes through
  int edge = 0;                 ///< kEdge: from corner `edge` (a, b, c) to the next one
};

/// Exact up to rounding, for every shape of triangle. Thread: any; nonblocking.
SegmentNearest nearest(const Segment& segment, const PreparedTriangle& triangle) noexcept;

/// Places at which a segment may be held by one triangle: along a flat one at both ends of the stretch that they share, along
/// an edge at the nearest points besides, since the two may cross.
struct SegmentTouches {
  std::array<SegmentNearest, 3> place;  ///< the first `count` are set; `distance` is negative beyond a triangle
  int count = 0;                        ///< 1 to 3
};
/// `at`: nearest() of the two. Thread: any; nonblocking.
SegmentTouches touchesOf(const Segment& segment, const PreparedTriangle& triangle, const SegmentNearest& at) noexcept;

}  // namespace presa
