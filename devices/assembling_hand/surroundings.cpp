#include "devices/assembling_hand/surroundings.h"

#include <cmath>
#include <numbers>

#include "devices/assembling_hand/grasp.h"
#include "framework/scene/physics_shapes.h"

namespace presa::assembling {
namespace {

constexpr double kInset = 0.8;                     // corners tested at this share of a box, clear of its neighbours
constexpr double kWellInside = 0.8;                // share of the workspace that is searched for room
constexpr double kFingersRoom = 2.5;               // in fingertip radii, around a body that is put down
constexpr double kBeside = 0.002, kAside = 0.003;  // [m]
constexpr double kStep = 0.02, kFarthest = 0.6;    // search for free space [m]
constexpr int kAround = 16;
constexpr double kLiftedBy = 0.012, kLiftedRadius = 0.004;  // [m]

}  // namespace

// Along the axes of its one shape, or of the body when it has several.
Surroundings::Bounds Surroundings::boundsOf(const Body& body, const BodyMeshes& meshes) {
  Bounds bounds;
  if (!body.physics) return bounds;
  bounds.solid = true;
  bounds.fixed = body.fixed;
  if (hasSeveralShapes(body, meshes)) {
    for (int axis = 0; axis < 3; ++axis) {
      const double high = supportOf(body, meshes, Vec3::Unit(axis)), low = -supportOf(body, meshes, -Vec3::Unit(axis));
      bounds.half[axis] = (high - low) / 2;
      bounds.X_BG.p[axis] = (high + low) / 2;
    }
    bounds.radius = bounds.half.norm();
    return bounds;
  }
  bounds.X_BG = body.physics->X_BG;
  const TriMesh* mesh = meshes.physics.get();
  for (int axis = 0; axis < 3; ++axis) bounds.half[axis] = halfWidth(body.physics->shape, mesh, Vec3::Unit(axis));
  if (mesh != nullptr && std::holds_alternative<MeshRef>(body.physics->shape)) {
    Vec3 low = mesh->vertices.front();
    for (const Vec3& v : mesh->vertices) low = low.cwiseMin(v);
    bounds.X_BG.p = bounds.X_BG * Vec3(low + bounds.half);
  }
  bounds.radius = bounds.half.norm();
  return bounds;
}

Surroundings::Surroundings(const World& world) {
  for (std::size_t i = 0; i < world.scene.bodies.size(); ++i)
    bounds_.push_back(boundsOf(world.scene.bodies[i], world.meshes[i]));
  if (world.scene.assembly) workspace_ = world.scene.assembly->workspace;
}

std::size_t Surroundings::bodyAt(const ObjectState& objects, const Vec3& p_W, double radius,
                                 std::size_t but) const noexcept {
  for (std::size_t i = 0; i < bounds_.size(); ++i) {
    const Bounds& bounds = bounds_[i];
    if (i == but || !bounds.solid) continue;
    const Pose X_WG = objects.bodies[i].X_WB_end * bounds.X_BG;
    const Vec3 away = p_W - X_WG.p;
    if (away.squaredNorm() > (bounds.radius + radius) * (bounds.radius + radius)) continue;
    const Vec3 outside = ((X_WG.q.conjugate() * away).cwiseAbs() - bounds.half).cwiseMax(Vec3::Zero());
    if (outside.squaredNorm() < radius * radius) return i;
  }
  return kNothing;
}

bool Surroundings::isOutOfReach(const ObjectState& objects, std::size_t body) const noexcept {
  if (!workspace_) return false;
  const Vec3 outside = (objects.bodies[body].X_WB_end.p - workspace_->centre).cwiseAbs() - workspace_->size / 2;
  return outside.maxCoeff() > 0;
}

std::size_t Surroundings::coverOf(const ObjectState& objects, std::size_t body) const noexcept {
  const Bounds& bounds = bounds_[body];
  const Pose X_WG = objects.bodies[body].X_WB_end * bounds.X_BG;
  for (int corner = 0; corner < 9; ++corner) {
    const Vec3 sign(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    const Vec3 p_G = corner == 8 ? Vec3::Zero() : Vec3(kInset * sign.cwiseProduct(bounds.half));
    const std::size_t cover = bodyAt(objects, X_WG * p_G + Vec3(0, 0, kLiftedBy), kLiftedRadius, body);
    if (cover != kNothing) return cover;
  }
  return kNothing;
}

Vec3 Surroundings::awayFromNeighbours(const ObjectState& objects, std::size_t body, const Pose& X_WB) const noexcept {
  const Bounds& bounds = bounds_[body];
  const Pose X_WG = X_WB * bounds.X_BG;
  Vec3 away = Vec3::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const Vec3 n_W = X_WG.q * Vec3(side * Vec3::Unit(axis));
      if (std::abs(n_W.z()) > 0.5) continue;  // skip the faces below and above
      const Vec3 beside = X_WG.p + (bounds.half[axis] + kBeside) * n_W;
      if (bodyAt(objects, beside, kBeside / 2, body) != kNothing) away -= kAside * n_W;
    }
  }
  return away;
}

// Seen from above, free bodies count as discs; a ball of this radius on the ground must not touch a fixed body.
bool Surroundings::isRoom(const ObjectState& objects, const Vec3& p_W, double radius, std::size_t but) const noexcept {
  if (workspace_) {
    const Vec3 inside = (p_W - workspace_->centre).cwiseAbs() - kWellInside * workspace_->size / 2;
    if (inside.x() > 0 || inside.y() > 0) return false;
  }
  const Vec3 centre(p_W.x(), p_W.y(), 1.02 * radius);
  for (std::size_t i = 0; i < bounds_.size(); ++i) {
    if (i == but || !bounds_[i].solid) continue;
    const Pose X_WG = objects.bodies[i].X_WB_end * bounds_[i].X_BG;
    const Vec3 away = centre - X_WG.p;
    if (bounds_[i].fixed) {
      const Vec3 outside = ((X_WG.q.conjugate() * away).cwiseAbs() - bounds_[i].half).cwiseMax(Vec3::Zero());
      if (outside.squaredNorm() < radius * radius) return false;
    } else if (away.head<2>().norm() < radius + bounds_[i].radius) {
      return false;
    }
  }
  return true;
}

std::optional<Vec3> Surroundings::roomFor(const ObjectState& objects, std::size_t body, const Vec3& p_W,
                                          double fingertip) const noexcept {
  const double radius = bounds_[body].radius + kFingersRoom * fingertip;
  for (double away = 0; away < kFarthest; away += kStep) {
    for (int k = 0; k < kAround; ++k) {
      const double angle = 2 * std::numbers::pi * k / kAround;
      const Vec3 there = p_W + away * Vec3(std::cos(angle), std::sin(angle), 0);
      if (isRoom(objects, there, radius, body)) return there;
    }
  }
  return std::nullopt;
}

}  // namespace presa::assembling
