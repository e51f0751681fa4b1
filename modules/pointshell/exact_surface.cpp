#include "modules/pointshell/exact_surface.h"

#include <algorithm>

#include "framework/haptics/touchables.h"

namespace presa {
namespace {

// Of a cylinder about z; points of its flat ends stay, those of the edges come onto the circle.
void ontoCylinder(double radius, Vec3& p, Vec3& normal) {
  constexpr double kFlat = 0.1;  // part of the normal across the axis below which a point lies on an end
  const double across = normal.head<2>().norm(), from_axis = p.head<2>().norm();
  if (across < kFlat || !(from_axis > 0)) return;
  p.head<2>() *= radius / from_axis;
  normal.head<2>() = across / radius * p.head<2>();
}

void ontoCapsule(double radius, double half_length, Vec3& p, Vec3& normal) {
  const Vec3 on_axis(0, 0, std::clamp(p.z(), -half_length, half_length)), from_axis = p - on_axis;
  if (!(from_axis.norm() > 0)) return;
  normal = from_axis.normalized();
  p = on_axis + radius * normal;
}

}  // namespace

PointShell::Exact exactSurfaceOf(const Geometry& tool) {
  const std::optional<Primitive> primitive = primitiveOf(tool);
  if (!primitive || primitive->kind == Primitive::Kind::kBox) return {};
  return [round = *primitive](Vec3& p, Vec3& normal) {
    const Pose& X_TG = round.X_AG;
    p = X_TG.inverseTimes(p);
    normal = X_TG.q.conjugate() * normal;
    if (round.kind == Primitive::Kind::kCylinder)
      ontoCylinder(round.radius, p, normal);
    else
      ontoCapsule(round.radius, round.kind == Primitive::Kind::kSphere ? 0 : round.half_length, p, normal);
    p = X_TG * p;
    normal = X_TG.q * normal;
  };
}

}  // namespace presa
