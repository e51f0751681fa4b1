#include "framework/geometry/convex_contact/cylinder.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "framework/geometry/convex_contact/nearest.h"

namespace presa {
namespace {

// sines
constexpr double kSideways = 1e-3;  // between the side and the tangent plane, up to which it lies on it
constexpr double kUpright = 1e-3;   // the same of a flat end, which then keeps the corners that it had

/// The part of the axis within `half` of the centre, with `radius`.
void placeAxis(double half, double radius, const Pose& X_WC, Hull& out) {
  const Vec3 along = X_WC.q * Vec3::UnitZ();
  out.centre = X_WC.p;
  out.radius = radius;
  out.vertices.resize(half > 0 ? 2 : 1);
  out.vertices.front() = X_WC.p - half * along;
  out.vertices.back() = X_WC.p + half * along;
  out.edges.resize(half > 0 ? 1 : 0);
  out.directions.resize(out.edges.size());
  if (half > 0) {
    out.edges.front() = {0, 1, -1, -1, 0};
    out.directions.front() = along;
  }
}

}  // namespace

Hull cylinderHull(double radius, double length) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 2 * kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * (i % kCorners) / kCorners;
    corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle), i < kCorners ? -length / 2 : length / 2);
  }
  std::vector<std::vector<std::int32_t>> loops(2);
  for (int i = 0; i < kCorners; ++i) {
    const int next = (i + 1) % kCorners;
    loops[0].insert(loops[0].begin(), i);
    loops[1].push_back(kCorners + i);
    loops.push_back({i, next, kCorners + next, kCorners + i});
  }
  Hull hull = polyhedron(corners, loops);
  hull.cylinder = {radius, length};
  return hull;
}

const Hull& CylinderStandIn::core(const Hull& cylinder, const Pose& X_WC) {
  placeAxis(std::max(0.0, cylinder.cylinder->length / 2 - cylinder.cylinder->radius), 0, X_WC, core_);
  return core_;
}

const Hull& CylinderStandIn::facing(const Hull& cylinder, const Pose& X_WC, const Vec3& towards_W, CylinderTurn& turn) {
  const Vec3 towards = X_WC.q.conjugate() * towards_W;
  if (std::abs(towards.z()) < kSideways) {
    placeAxis(cylinder.cylinder->length / 2, cylinder.cylinder->radius, X_WC, side_);
    return side_;
  }
  if (std::hypot(towards.x(), towards.y()) > kUpright) turn.angle = std::atan2(towards.y(), towards.x());
  const Quat turned(Eigen::AngleAxisd(turn.angle, Vec3::UnitZ()));
  place(cylinder, {X_WC.p, X_WC.q * turned}, prism_);
  return prism_;
}

std::pair<const Hull*, const Hull*> FacingHulls::of(const Side& A, const Side& B) {
  const auto core = [&](const Side& side, CylinderStandIn& stand_in) {
    return side.hull.cylinder ? &stand_in.core(side.hull, side.X_WH) : side.placed;
  };
  const Hull *a = core(A, stand_ins_[0]), *b = core(B, stand_ins_[1]);
  if (!A.hull.cylinder && !B.hull.cylinder) return {a, b};
  const Vec3 way = shortestWay(*a, *b);
  if (A.hull.cylinder) a = &stand_ins_[0].facing(A.hull, A.X_WH, way, *A.turn);
  if (B.hull.cylinder) b = &stand_ins_[1].facing(B.hull, B.X_WH, -way, *B.turn);
  return {a, b};
}

Vec3 shortestWay(const Hull& A, const Hull& B) {
  Vec3 on_a, on_b;
  bool apart = true;
  if (!A.faces.empty()) {
    apart = nearestOutside(A, B, on_a, on_b);
  } else if (!B.faces.empty()) {
    apart = nearestOutside(B, A, on_b, on_a);
  } else {
    std::tie(on_a, on_b) = nearestOf(A.vertices.front(), A.vertices.back(), B.vertices.front(), B.vertices.back());
  }
  const Vec3 way = apart ? Vec3(on_b - on_a) : Vec3(B.centre - A.centre);
  return way.norm() > 0 ? Vec3(way.normalized()) : Vec3::UnitZ();
}

}  // namespace presa
