#include "experiments/study/box_penetration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "framework/scene/physics_shapes.h"

namespace presa {
namespace {

constexpr double kParallel = 1e-9;  // cross products shorter than this give no separating axis

double extentAlong(const Vec3& half, const Mat3& R, const Vec3& axis) {
  return (R.transpose() * axis).cwiseAbs().dot(half);
}

}  // namespace

double boxPenetration(const Vec3& size_A, const Pose& X_WA, const Vec3& size_B, const Pose& X_WB) {
  const Vec3 half_A = size_A / 2, half_B = size_B / 2, between = X_WB.p - X_WA.p;
  const Mat3 A = X_WA.q.toRotationMatrix(), B = X_WB.q.toRotationMatrix();
  double min = std::numeric_limits<double>::infinity();
  const auto parted_along = [&](Vec3 axis) {
    const double length = axis.norm();
    if (length < kParallel) return false;
    axis /= length;
    const double overlap = extentAlong(half_A, A, axis) + extentAlong(half_B, B, axis) - std::abs(between.dot(axis));
    min = std::min(min, overlap);
    return overlap <= 0;
  };
  for (int i = 0; i < 3; ++i) {
    if (parted_along(A.col(i)) || parted_along(B.col(i))) return 0;
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (parted_along(A.col(i).cross(B.col(j)))) return 0;
    }
  }
  return min;
}

PenetrationCheck::PenetrationCheck(const World& world) {
  for (std::size_t i = 0; i < world.scene.bodies.size(); ++i) {
    const Body& body = world.scene.bodies[i];
    for (const PhysicsShape& shape : physicsShapes(body, world.meshes[i])) {
      if (const auto* box = std::get_if<Box>(shape.shape)) {
        boxes_.push_back({i, box->size, shape.X_BG, body.fixed, box->size.norm() / 2});
      }
    }
  }
}

std::size_t PenetrationCheck::pairs() const noexcept {
  std::size_t fixed = 0;
  for (const BoxBody& box : boxes_) fixed += box.fixed ? 1 : 0;
  const auto of = [](std::size_t n) { return n * (n - 1) / 2; };
  return of(boxes_.size()) - of(fixed);
}

PenetrationCheck::Result PenetrationCheck::measure(const ObjectState& objects) const {
  Result result;
  std::vector<Pose> poses;
  for (const BoxBody& box : boxes_) poses.push_back(objects.bodies[box.body].X_WB_end * box.X_BG);
  for (std::size_t a = 0; a < boxes_.size(); ++a) {
    for (std::size_t b = a + 1; b < boxes_.size(); ++b) {
      if ((boxes_[a].fixed && boxes_[b].fixed) || boxes_[a].body == boxes_[b].body) continue;
      if ((poses[a].p - poses[b].p).norm() > boxes_[a].radius + boxes_[b].radius) continue;
      const double depth = boxPenetration(boxes_[a].size, poses[a], boxes_[b].size, poses[b]);
      if (!(depth > 0)) continue;
      ++result.pairs;
      result.mean += depth;
      result.max = std::max(result.max, depth);
    }
  }
  if (result.pairs > 0) result.mean /= static_cast<double>(result.pairs);
  return result;
}

}  // namespace presa
