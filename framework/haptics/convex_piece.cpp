#include "framework/haptics/convex_piece.h"

#include <algorithm>
#include <cmath>

namespace presa {
namespace {

Vec3 unitOr(const Vec3& v, const Vec3& fallback) noexcept {
  const double norm = v.norm();
  return norm > 0 ? Vec3(v / norm) : fallback;
}

// p in the geometry frame, also in the two functions below
Nearest nearestBox(const Vec3& half, const Vec3& p) noexcept {
  const Vec3 over = p.cwiseAbs() - half;
  if (over.maxCoeff() <= 0) {
    int axis = 0;
    const double depth = over.maxCoeff(&axis);
    Vec3 nhat = Vec3::Zero();
    nhat[axis] = p[axis] < 0 ? -1.0 : 1.0;
    return {nhat, depth};
  }
  const Vec3 away = p - p.cwiseMax(-half).cwiseMin(half);
  const double distance = away.norm();
  return {away / distance, distance};
}

Nearest nearestCylinder(double radius, double half_length, const Vec3& p) noexcept {
  const double rho = std::hypot(p.x(), p.y());
  const Vec3 radial = rho > 0 ? Vec3(p.x() / rho, p.y() / rho, 0) : Vec3::UnitX();
  const Vec3 axial(0, 0, p.z() < 0 ? -1.0 : 1.0);
  const double over_side = rho - radius;
  const double over_cap = std::abs(p.z()) - half_length;
  if (over_side <= 0 && over_cap <= 0) {
    return over_side > over_cap ? Nearest{radial, over_side} : Nearest{axial, over_cap};
  }
  const double side = std::max(over_side, 0.0);
  const double cap = std::max(over_cap, 0.0);
  const double distance = std::hypot(side, cap);
  return {(side * radial + cap * axial) / distance, distance};
}

Nearest nearestCapsule(double radius, double half_length, const Vec3& p) noexcept {
  const Vec3 on_axis(0, 0, std::clamp(p.z(), -half_length, half_length));
  const Vec3 away = p - on_axis;
  return {unitOr(away, Vec3::UnitX()), away.norm() - radius};
}

Nearest nearestPrimitive(const Primitive& primitive, const Vec3& p) noexcept {
  const Vec3 p_G = primitive.X_AG.inverseTimes(p);
  Nearest result;
  switch (primitive.kind) {
    case Primitive::Kind::kBox:
      result = nearestBox(primitive.half, p_G);
      break;
    case Primitive::Kind::kCylinder:
      result = nearestCylinder(primitive.radius, primitive.half_length, p_G);
      break;
    case Primitive::Kind::kSphere:
      result = nearestCapsule(primitive.radius, 0, p_G);
      break;
    case Primitive::Kind::kCapsule:
      result = nearestCapsule(primitive.radius, primitive.half_length, p_G);
      break;
  }
  result.nhat = primitive.X_AG.q * result.nhat;
  return result;
}

}  // namespace

Nearest nearest(const ConvexPiece& piece, const Vec3& p) noexcept {
  if (const auto* triangle = std::get_if<PreparedTriangle>(&piece.shape)) return nearest(*triangle, p);
  return nearestPrimitive(*std::get_if<Primitive>(&piece.shape), p);
}

}  // namespace presa
