#include "devices/assembling_hand/grasp.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "framework/scene/physics_shapes.h"

namespace presa::assembling {
namespace {

constexpr double kTowardsTop = 0.75;  // share of the half height: a body grasped there hangs with its top up
constexpr double kSafety = 2.5;       // grip over the min grip that carries the body
constexpr double kMinGrip = 0.5;      // [N]
constexpr double kLevel = 0.6;        // sine: axes closer to horizontal than this count as level

Vec3 level(double yaw) { return {std::cos(yaw), std::sin(yaw), 0}; }

}  // namespace

double halfWidth(const Shape& shape, const TriMesh* mesh, const Vec3& n_G) {
  return (supportOf(shape, mesh, n_G) + supportOf(shape, mesh, -n_G)) / 2;
}

double halfWidth(const World& world, std::size_t i, const Vec3& n_B) {
  const Body& body = world.scene.bodies[i];
  return (supportOf(body, world.meshes[i], n_B) + supportOf(body, world.meshes[i], -n_B)) / 2;
}

double outTo(const World& world, std::size_t i, const Vec3& n_B) {
  double half = halfWidth(world, i, n_B);
  if (const Box* box = std::get_if<Box>(&world.scene.bodies[i].physics->shape)) {
    const Vec3 n_G = world.scene.bodies[i].physics->X_BG.q.conjugate() * n_B;
    for (int axis = 0; axis < 3; ++axis)
      half = std::min(half, box->size[axis] / 2 / std::max(1e-9, std::abs(n_G[axis])));
  }
  const TriMesh* mesh = world.meshes[i].physics.get();
  if (!std::holds_alternative<MeshRef>(world.scene.bodies[i].physics->shape) || mesh == nullptr) return half;
  const Pose& X_BG = world.scene.bodies[i].physics->X_BG;
  double out = half;
  for (const auto& triangle : mesh->triangles) {
    const Vec3 a = X_BG * mesh->vertices[static_cast<std::size_t>(triangle[0])],
               b = X_BG * mesh->vertices[static_cast<std::size_t>(triangle[1])],
               c = X_BG * mesh->vertices[static_cast<std::size_t>(triangle[2])];
    const Vec3 outward = (b - a).cross(c - a);
    const double along = outward.dot(n_B);
    if (along > 0) out = std::min(out, outward.dot(a - world.inertias[i].p_BCm) / along);
  }
  return out;
}

Lines linesToHang(const World& world, std::size_t i, const Pose& X_WB, const Vec3& up_B, double yaw) {
  const Vec3 up_W = X_WB.q * up_B;
  Lines lines;
  if (std::abs(up_W.z()) < kStands) {
    lines.add(Vec3::UnitZ().cross(up_W));
  } else if (std::holds_alternative<Cylinder>(world.scene.bodies[i].physics->shape)) {
    for (std::size_t n = 0; n < Lines::kCapacity; ++n)
      lines.add(level(yaw + std::numbers::pi * static_cast<double>(n) / Lines::kCapacity));
  } else {
    lines = linesToMove(world, i, X_WB);
  }
  return lines;
}

Lines linesToMove(const World& world, std::size_t i, const Pose& X_WB) {
  Lines lines;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 n_W = X_WB.q * Vec3::Unit(axis);
    if (std::abs(n_W.z()) < kLevel) lines.add(n_W);
  }
  std::ranges::stable_sort(std::span(lines.a_W).first(lines.count), {},
                           [&](const Vec3& n_W) { return halfWidth(world, i, X_WB.q.conjugate() * n_W); });
  return lines;
}

Grasp graspAlong(const World& world, std::size_t i, const Pose& X_WB, const Vec3& top_B, const Vec3& a_W, double yaw) {
  Grasp grasp;
  grasp.a_B = X_WB.q.conjugate() * (a_W.dot(level(yaw)) < 0 ? Vec3(-a_W) : a_W);
  grasp.p_BC = world.inertias[i].p_BCm + kTowardsTop * outTo(world, i, top_B) * top_B;
  grasp.half = halfWidth(world, i, grasp.a_B);
  const double mu = std::max(0.1, world.scene.materialOf(world.scene.bodies[i]).friction_dynamic);
  grasp.force = std::clamp(kSafety * world.inertias[i].mass * 9.81 / (2 * mu), kMinGrip, kMaxGrip);
  return grasp;
}

}  // namespace presa::assembling
