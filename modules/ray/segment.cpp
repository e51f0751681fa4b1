// Distance of a segment and a triangle: the minimum of the ends of the segment against the triangle and the segment
// against the three edges [Ericson2004 5.1.9], or zero where the segment goes through the triangle.
#include "modules/ray/segment.h"

#include <algorithm>
#include <cmath>

namespace presa {
namespace {

constexpr double kFlat =
    1 - 3e-4;  // squared cosine above which the nearest direction counts as that of the face: 1 degree
constexpr double kShort = 5e-4;  // stretch that counts as one place [m]
constexpr double kAlong = 0.05;  // sine below which segment and edge count as parallel

void takeNearer(SegmentNearest& best, double& best_square, double s, const Vec3& on_segment, const Vec3& on_body,
                SegmentNearest::Where where) noexcept {
  const Vec3 away = on_segment - on_body;
  const double square = away.squaredNorm();
  if (!(square <= best_square)) return;
  best_square = square;
  best.nhat = away;
  best.s = s;
  best.on_body = on_body;
  best.where = where;
}

/// Parameters of the nearest points of p + s d and q + t e, both 0 to 1.
std::array<double, 2> nearestOfLines(const Vec3& p, const Vec3& d, double dd, const Vec3& q, const Vec3& e) noexcept {
  const Vec3 r = p - q;
  const double ee = e.squaredNorm(), er = e.dot(r);
  if (!(ee > 0)) return {dd > 0 ? std::clamp(-d.dot(r) / dd, 0.0, 1.0) : 0, 0};
  if (!(dd > 0)) return {0, std::clamp(er / ee, 0.0, 1.0)};
  const double dr = d.dot(r), de = d.dot(e), square = dd * ee - de * de;
  double s = square > 1e-12 * dd * ee ? std::clamp((de * er - dr * ee) / square, 0.0, 1.0) : 0.5;
  double t = (de * s + er) / ee;
  if (t < 0 || t > 1) {
    t = std::clamp(t, 0.0, 1.0);
    s = std::clamp((t * de - dr) / dd, 0.0, 1.0);
  }
  return {s, t};
}

bool goesThrough(const Segment& segment, const PreparedTriangle& t, const Vec3& normal, double longest,
                 double& s) noexcept {
  const double from = normal.dot(segment.a - t.a), to = normal.dot(segment.b - t.a);
  if (from * to > 0 || from == to) return false;
  s = from / (from - to);
  const Vec3 x = segment.at(s);
  if ((x - t.a).squaredNorm() > longest) return false;
  // rounding of the corners, and of x far from the origin
  return (closestOnTriangle(x, t) - x).squaredNorm() <= 1e-24 * longest + 1e-30 * x.squaredNorm();
}

}  // namespace

SegmentNearest nearest(const Segment& segment, const PreparedTriangle& t) noexcept {
  SegmentNearest best;
  const Vec3 d = segment.b - segment.a, normal = t.ab.cross(t.ac);
  const double longest = std::max(t.ab_ab, t.ac_ac);
  double s = 0;
  if (goesThrough(segment, t, normal, longest, s)) {
    best.where = SegmentNearest::Where::kCrossing;
    best.distance = 0;
    best.s = s;
    best.on_body = segment.at(s);
    if (normal.squaredNorm() > 0) best.nhat = normal.normalized();
    return best;
  }
  double square = 1e300;
  const double dd = d.squaredNorm();
  const std::array<const Vec3*, 4> corners{&t.a, &t.b, &t.c, &t.a};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 e = *corners[i + 1] - *corners[i];
    const auto [on, along] = nearestOfLines(segment.a, d, dd, *corners[i], e);
    const double before = square;
    takeNearer(best, square, on, segment.a + on * d, *corners[i] + along * e, SegmentNearest::Where::kEdge);
    if (square < before) best.edge = static_cast<int>(i);
  }
  // an end farther from a corner than that cannot be nearer
  const double far = 2 * (square + longest);
  for (const double end : {0.0, 1.0}) {
    const Vec3& p = end == 0 ? segment.a : segment.b;
    if ((p - t.a).squaredNorm() <= far)
      takeNearer(best, square, end, p, closestOnTriangle(p, t), SegmentNearest::Where::kEnd);
  }
  best.distance = std::sqrt(square);
  if (best.distance > 0) {
    best.nhat /= best.distance;
  } else if (normal.squaredNorm() > 0) {
    best.nhat = normal.normalized();
  }
  return best;
}

namespace {

/// The stretch of the segment above the triangle, along its normal.
SegmentTouches alongFace(const Segment& segment, const PreparedTriangle& t, const Vec3& nhat) noexcept {
  const Vec3 d = segment.b - segment.a;
  double from = 0, to = 1;
  const std::array<const Vec3*, 4> corners{&t.a, &t.b, &t.c, &t.a};
  const Vec3 normal = t.ab.cross(t.ac);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 inward = normal.cross(*corners[i + 1] - *corners[i]);
    const double at = inward.dot(segment.a - *corners[i]), slope = inward.dot(d);
    if (slope > 0) from = std::max(from, -at / slope);
    if (slope < 0) to = std::min(to, -at / slope);
  }
  SegmentTouches touches;
  if (!((to - from) * d.norm() > kShort)) return touches;
  for (const double s : {from, to}) {
    const double height = nhat.dot(segment.at(s) - t.a);
    touches.place[static_cast<std::size_t>(touches.count++)] = {
        .nhat = nhat, .distance = height, .s = s, .on_body = segment.at(s) - height * nhat};
  }
  return touches;
}

/// The stretch that the segment and a nearly parallel edge share.
SegmentTouches alongEdge(const Segment& segment, const Vec3& from, const Vec3& to) noexcept {
  const Vec3 d = segment.b - segment.a;
  const double s0 = d.dot(from - segment.a) / d.squaredNorm(), s1 = d.dot(to - segment.a) / d.squaredNorm();
  SegmentTouches touches;
  if (!(std::abs(s1 - s0) * d.norm() > kShort)) return touches;
  for (const double s : {std::clamp(std::min(s0, s1), 0.0, 1.0), std::clamp(std::max(s0, s1), 0.0, 1.0)}) {
    const Vec3 x = segment.at(s), q = closestOnSegment(x, from, to);
    const double distance = (x - q).norm();
    if (!(distance > 0)) return {};
    touches.place[static_cast<std::size_t>(touches.count++)] = {
        .nhat = (x - q) / distance, .distance = distance, .s = s, .on_body = q};
  }
  return touches;
}

}  // namespace

SegmentTouches touchesOf(const Segment& segment, const PreparedTriangle& t, const SegmentNearest& at) noexcept {
  SegmentTouches touches;
  const Vec3 d = segment.b - segment.a;
  if (at.where == SegmentNearest::Where::kCrossing) {
    // the end behind the face is to come out of it
    const double a = at.nhat.dot(segment.a - t.a), b = at.nhat.dot(segment.b - t.a);
    SegmentNearest behind = at;
    behind.s = a < b ? 0 : 1;
    behind.distance = std::min(a, b);
    behind.on_body = segment.at(behind.s) - behind.distance * behind.nhat;
    touches.place[0] = behind;
    touches.count = 1;
    return touches;
  }
  const Vec3 normal = t.ab.cross(t.ac);
  const double cosine = normal.dot(at.nhat);
  if (cosine * cosine > kFlat * normal.squaredNorm())
    touches = alongFace(segment, t, (cosine > 0 ? 1 : -1) * normal.normalized());
  if (touches.count == 0 && at.where == SegmentNearest::Where::kEdge) {
    const std::array<const Vec3*, 4> corners{&t.a, &t.b, &t.c, &t.a};
    const auto i = static_cast<std::size_t>(at.edge);
    const Vec3 e = *corners[i + 1] - *corners[i];
    if (d.cross(e).squaredNorm() < kAlong * kAlong * d.squaredNorm() * e.squaredNorm())
      touches = alongEdge(segment, *corners[i], *corners[i + 1]);
    if (touches.count == 2) touches.place[static_cast<std::size_t>(touches.count++)] = at;
  }
  if (touches.count == 0) {
    touches.place[0] = at;
    touches.count = 1;
  }
  return touches;
}

}  // namespace presa
