#include "devices/assembling_hand/grasp.h"

#include <algorithm>
#include <cmath>

namespace presa::assembling {
namespace {

constexpr double kTowardsTop = 0.75;  // of half the height: a body that is taken there hangs with its top up
constexpr double kSafety = 2.5;       // of the grip over the least that carries
constexpr double kLeastGrip = 0.5, kMostGrip = 6;  // [N]
constexpr double kFlat = 0.02;   // half a height of which fingertips on the ground reach too little [m]
constexpr double kStands = 0.9;  // cosine: upright, or on its head

Vec3 level(double yaw) { return {std::cos(yaw), std::sin(yaw), 0}; }

}  // namespace

double halfWidth(const Shape& shape, const TriMesh* mesh, const Vec3& n_G) {
  struct Measure {
    const TriMesh* mesh;
    Vec3 n;
    double operator()(const Box& box) const { return n.cwiseAbs().dot(box.size) / 2; }
    double operator()(const Sphere& sphere) const { return sphere.radius; }
    double operator()(const Cylinder& rod) const {
      return rod.radius * std::hypot(n.x(), n.y()) + rod.length / 2 * std::abs(n.z());
    }
    double operator()(const Capsule& rod) const { return rod.radius + rod.length / 2 * std::abs(n.z()); }
    double operator()(const MeshRef&) const {
      if (mesh == nullptr || mesh->vertices.empty()) return 0;
      double least = mesh->vertices[0].dot(n), most = least;
      for (const Vec3& v : mesh->vertices) {
        least = std::min(least, v.dot(n));
        most = std::max(most, v.dot(n));
      }
      return (most - least) / 2;
    }
  };
  return std::visit(Measure{mesh, n_G}, shape);
}

Grasp chooseGrasp(const World& world, std::size_t i, const Pose& X_WB, const Pose& X_WG, double yaw) {
  const Body& body = world.scene.bodies[i];
  const Geometry& physics = *body.physics;
  const TriMesh* mesh = world.meshes[i].physics.get();
  const auto half_along = [&](const Vec3& n_B) {
    return halfWidth(physics.shape, mesh, physics.X_BG.q.conjugate() * n_B);
  };
  const Vec3 up_B = X_WG.q.conjugate() * Vec3::UnitZ(), up_W = X_WB.q * up_B;

  Grasp grasp;
  Vec3 a_W = level(yaw);
  if (std::abs(up_W.z()) < kStands) {
    a_W = Vec3::UnitZ().cross(up_W).normalized();  // about which it swings upright
  } else {
    // the narrower of the two pairs of faces
    double least = 1e9;
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 n_B = Vec3::Unit(axis);
      const Vec3 n_W = X_WB.q * n_B;
      if (std::abs(n_W.z()) > 0.3 || half_along(n_B) >= least) continue;
      least = half_along(n_B);
      a_W = Vec3(n_W.x(), n_W.y(), 0).normalized();
    }
  }
  if (a_W.dot(level(yaw)) < 0) a_W = -a_W;
  grasp.a_B = X_WB.q.conjugate() * a_W;
  Vec3 top_B = up_B;
  if (up_W.z() < -kStands && half_along(up_B) < kFlat) {
    top_B = up_B.cross(grasp.a_B).normalized();
    grasp.lays_down = true;
    grasp.rise = half_along(top_B) - half_along(up_B);
  }
  grasp.p_BC = world.inertias[i].p_BCm + kTowardsTop * half_along(top_B) * top_B;
  grasp.half = half_along(grasp.a_B);
  const double mu = std::max(0.1, world.scene.materialOf(body).friction_dynamic);
  grasp.force = std::clamp(kSafety * world.inertias[i].mass * 9.81 / (2 * mu), kLeastGrip, kMostGrip);
  return grasp;
}

}  // namespace presa::assembling
