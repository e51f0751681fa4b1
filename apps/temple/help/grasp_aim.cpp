#include "apps/temple/help/grasp_aim.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "framework/scene/physics_shapes.h"

namespace presa::temple {
namespace {

constexpr double kAboveCentre = 0.25;  // of the half height: what is held above its centre hangs upright
constexpr double kTowardsTop = 0.3;    // of the half length, where a lying drum is taken so that it swings upright
constexpr double kWidest = 0.055;      // half width that the open fingertips take with room [m]
constexpr double kStands = 0.9;        // cosine between a body axis and the vertical

/// `yaw` or yaw + pi, whichever is nearer to `wanted`.
double nearestHalfTurn(double yaw, double wanted) noexcept {
  return yaw + std::numbers::pi * std::round((wanted - yaw) / std::numbers::pi);
}

BlockShape shapeOf(const World& world, std::size_t i) {
  const Body& body = world.scene.bodies[i];
  if (body.fixed || !body.physics) return {};
  const Shape& shape = body.physics->shape;
  if (const Box* box = std::get_if<Box>(&shape)) return {box->size / 2, false};
  if (const Cylinder* rod = std::get_if<Cylinder>(&shape)) return {{rod->radius, rod->radius, rod->length / 2}, true};
  if (const Compound* compound = std::get_if<Compound>(&shape)) {
    BlockShape block{Vec3::Zero(), std::holds_alternative<Cylinder>(compound->parts.front().shape)};
    for (int axis = 0; axis < 3; ++axis) {
      for (const double side : {-1.0, 1.0})
        block.half[axis] = std::max(block.half[axis], supportOf(body, world.meshes[i], side * Vec3::Unit(axis)));
    }
    return block;
  }
  if (!world.meshes[i].physics) return {};
  Vec3 half = Vec3::Zero();
  for (const Vec3& vertex : world.meshes[i].physics->vertices) half = half.cwiseMax(vertex.cwiseAbs());
  return {half, false};
}

/// The level body axis across which the block is taken: narrow enough, and nearest to the wanted direction.
void chooseAcross(const BlockShape& shape, const Mat3& R_WB, int up, double wanted, GraspAim& aim) noexcept {
  double best = 1e300;
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == up) continue;
    const double yaw = nearestHalfTurn(std::atan2(R_WB(1, axis), R_WB(0, axis)), wanted);
    const double effort = std::abs(yaw - wanted) + (shape.half[axis] > kWidest ? 100 * shape.half[axis] : 0);
    if (effort >= best) continue;
    best = effort;
    aim.yaw = yaw;
    aim.half = shape.half[axis];
  }
}

}  // namespace

std::vector<BlockShape> blockShapes(const World& world) {
  std::vector<BlockShape> shapes;
  for (std::size_t i = 0; i < world.scene.bodies.size(); ++i) shapes.push_back(shapeOf(world, i));
  return shapes;
}

GraspAim aimAt(const BlockShape& shape, const Pose& X_WB, double yaw, double fingertip) noexcept {
  const Mat3 R_WB = X_WB.q.toRotationMatrix();
  int up = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (std::abs(R_WB(2, axis)) > std::abs(R_WB(2, up))) up = axis;
  const double high = R_WB.row(2).cwiseAbs().dot(shape.half);
  GraspAim aim{X_WB.p, yaw, shape.half.x(), X_WB.p.z() + high, X_WB.p.z() - high};
  if (!shape.round) {
    chooseAcross(shape, R_WB, up, yaw, aim);
  } else if (std::abs(R_WB(2, 2)) < kStands) {
    aim.yaw = nearestHalfTurn(std::atan2(R_WB(1, 2), R_WB(0, 2)) + std::numbers::pi / 2, yaw);
    aim.p_W += kTowardsTop * shape.half.z() * R_WB.col(2);
  }
  aim.p_W.z() = std::max(aim.p_W.z() + kAboveCentre * high, aim.bottom + fingertip + 0.002);
  return aim;
}

}  // namespace presa::temple
