#include "framework/scene/inertia.h"

#include <Eigen/Eigenvalues>
#include <numbers>

#include "framework/scene/xml/value_rule.h"

namespace presa {
namespace {

using std::numbers::pi;

/// Principal moments of a real body obey the triangle inequality; allowance for rounding [-].
constexpr double kInequalitySlack = 1e-9;
constexpr double kGivenSlack = 1e-6;  // for an inertia that somebody wrote in decimals

MassProperties centred(double volume, const Vec3& moments) { return {volume, Vec3::Zero(), moments.asDiagonal()}; }

MassProperties of(const Box& box) {
  const Vec3 squares = box.size.cwiseAbs2();
  const double volume = box.size.prod();
  return centred(volume,
                 volume / 12 * Vec3(squares.y() + squares.z(), squares.z() + squares.x(), squares.x() + squares.y()));
}

MassProperties of(const Sphere& sphere) {
  const double volume = 4.0 / 3.0 * pi * sphere.radius * sphere.radius * sphere.radius;
  return centred(volume, Vec3::Constant(0.4 * volume * sphere.radius * sphere.radius));
}

MassProperties of(const Cylinder& cylinder) {
  const double r2 = cylinder.radius * cylinder.radius, l2 = cylinder.length * cylinder.length;
  const double volume = pi * r2 * cylinder.length;
  const double across = volume * (r2 / 4 + l2 / 12);
  return centred(volume, {across, across, 0.5 * volume * r2});
}

MassProperties of(const Capsule& capsule) {
  const double r = capsule.radius, l = capsule.length;
  const MassProperties middle = of(Cylinder{r, l});
  const MassProperties caps = of(Sphere{r});
  // the centroid of each half-sphere lies 3/8 r beyond the end of the cylinder
  const double across = middle.inertia(0, 0) + caps.inertia(0, 0) + caps.volume * (l * l / 4 + 3 * l * r / 8);
  return centred(middle.volume + caps.volume, {across, across, middle.inertia(2, 2) + caps.inertia(2, 2)});
}

Vec3 principalMoments(const Mat3& inertia) {
  return Eigen::SelfAdjointEigenSolver<Mat3>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
}

bool physical(const BodyInertia& inertia, double slack) {
  if (!(inertia.mass > 0) || !inertia.p_BCm.allFinite() || !inertia.inertia.allFinite()) return false;
  const Vec3 moments = principalMoments(inertia.inertia);
  return moments[0] > 0 && moments[0] + moments[1] >= moments[2] * (1 - slack);
}

/// In the frame of `part`'s geometry.
MassProperties placed(const MassProperties& part, const Pose& X_GP) {
  const Mat3 R = X_GP.q.toRotationMatrix();
  return {part.volume, X_GP * part.center, R * part.inertia * R.transpose()};
}

/// The sum, about the common centroid (parallel axis theorem).
MassProperties sumOf(const std::vector<MassProperties>& parts) {
  MassProperties sum;
  for (const MassProperties& part : parts) {
    sum.volume += part.volume;
    sum.center += part.volume * part.center;
  }
  sum.center /= sum.volume;
  for (const MassProperties& part : parts) {
    const Vec3 r = part.center - sum.center;
    sum.inertia += part.inertia + part.volume * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
  }
  return sum;
}

MassProperties massPropertiesOf(const Geometry& physics, const BodyMeshes& meshes) {
  const auto* compound = std::get_if<Compound>(&physics.shape);
  if (compound == nullptr) return massPropertiesOf(physics.shape, meshes.physics.get());
  std::vector<MassProperties> parts;
  for (std::size_t k = 0; k < compound->parts.size(); ++k) {
    const ShapePart& part = compound->parts[k];
    const TriMesh* mesh = k < meshes.parts.size() ? meshes.parts[k].get() : nullptr;
    parts.push_back(placed(massPropertiesOf(part.shape, mesh), part.X_GP));
  }
  return sumOf(parts);
}

}  // namespace

MassProperties massPropertiesOf(const Shape& shape, const TriMesh* mesh) {
  return std::visit(
      [&](const auto& concrete) {
        if constexpr (std::is_same_v<std::decay_t<decltype(concrete)>, MeshRef>) {
          return mesh != nullptr ? massProperties(*mesh) : MassProperties{};
        } else if constexpr (std::is_same_v<std::decay_t<decltype(concrete)>, Compound>) {
          return MassProperties{};
        } else {
          return of(concrete);
        }
      },
      shape);
}

BodyInertia inertiaOf(const Body& body, const BodyMeshes& meshes, Diagnostics& diagnostics) {
  if (body.fixed) return {};
  if (!body.physics) {
    diagnostics.error(320, body.where, "body '" + body.name + "' is free but has no physics geometry",
                      "add <physics> with a mass or density, or make it fixed=\"true\"");
    return {};
  }
  const MassProperties unit = massPropertiesOf(*body.physics, meshes);
  const Mat3 R_BG = body.physics->X_BG.q.toRotationMatrix();
  const double density = body.mass ? *body.mass / unit.volume : body.density.value_or(0.0);
  BodyInertia result;
  result.mass = body.mass ? *body.mass : density * unit.volume;
  result.p_BCm = body.physics->X_BG * unit.center;
  result.inertia = density * R_BG * unit.inertia * R_BG.transpose();
  if (body.p_BCm) result.p_BCm = *body.p_BCm;
  if (body.inertia_B) result.inertia = *body.inertia_B;
  if (body.inertia_B && !physical(result, kGivenSlack)) {
    const Vec3 moments = principalMoments(result.inertia);
    diagnostics.error(321, body.physics->where,
                      "body '" + body.name + "': no real body has the principal moments of its 'inertia', " +
                          xml::numberText(moments[0]) + ", " + xml::numberText(moments[1]) + " and " +
                          xml::numberText(moments[2]) + " kg m^2",
                      "its principal moments are positive, and none is larger than the sum of the two others");
    return {};
  }
  if (!body.inertia_B && !physical(result, kInequalitySlack)) {
    diagnostics.error(321, body.physics->where,
                      "body '" + body.name + "': its physics geometry gives a mass of " + std::to_string(result.mass) +
                          " kg and a volume of " + std::to_string(unit.volume) + " m^3, no physically valid inertia",
                      "give a positive mass or density and a geometry that encloses a volume");
    return {};
  }
  return result;
}

}  // namespace presa
