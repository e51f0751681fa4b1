#include "experiments/study/free_motion.h"

#include <algorithm>
#include <cmath>

namespace presa {
namespace {

constexpr double kAnglePerStep = 1e-3;  // [rad]: keeps the local error of RK4 at rounding level

using Coefficients = Eigen::Vector4d;

/// q' = 1/2 (0, w) q, with w from the constant angular momentum.
Coefficients rate(const Coefficients& xyzw, const Mat3& inverse_inertia, const Vec3& momentum_W) {
  const Quat q(xyzw);
  const Quat unit = q.normalized();
  const Vec3 w_W = unit * (inverse_inertia * (unit.conjugate() * momentum_W));
  return 0.5 * (Quat(0, w_W.x(), w_W.y(), w_W.z()) * q).coeffs();
}

}  // namespace

FreeMotion::FreeMotion(std::shared_ptr<const World> world)
    : world_(std::move(world)), rotations_(world_->scene.bodies.size()) {
  for (std::size_t i = 0; i < rotations_.size(); ++i) {
    const Body& body = world_->scene.bodies[i];
    const Mat3& inertia = world_->inertias[i].inertia;
    Rotation& rotation = rotations_[i];
    rotation.q_WB = body.X_WB.q;
    rotation.momentum_W = body.X_WB.q * (inertia * (body.X_WB.q.conjugate() * body.w_WB));
    if (body.w_WB.norm() > 0) rotation.step = kAnglePerStep / body.w_WB.norm();
  }
}

void FreeMotion::turn(std::size_t i, double time) {
  Rotation& rotation = rotations_[i];
  const double span = time - rotation.time;
  if (rotation.momentum_W.isZero() || !(span > 0)) return;
  const Mat3 inverse = world_->inertias[i].inertia.inverse();
  const auto steps = static_cast<long>(std::ceil(span / rotation.step));
  const double h = span / static_cast<double>(steps);
  Coefficients x = rotation.q_WB.coeffs();
  for (long s = 0; s < steps; ++s) {
    const Coefficients k1 = rate(x, inverse, rotation.momentum_W);
    const Coefficients k2 = rate(x + 0.5 * h * k1, inverse, rotation.momentum_W);
    const Coefficients k3 = rate(x + 0.5 * h * k2, inverse, rotation.momentum_W);
    const Coefficients k4 = rate(x + h * k3, inverse, rotation.momentum_W);
    x += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    x.normalize();
  }
  rotation.q_WB.coeffs() = x;
  rotation.time = time;
}

Pose FreeMotion::at(std::size_t i, double time) {
  const Body& body = world_->scene.bodies[i];
  if (body.fixed) return body.X_WB;
  turn(i, time);
  const BodyInertia& inertia = world_->inertias[i];
  const Vec3 acceleration = world_->scene.gravity + body.force_W / inertia.mass;
  const Vec3 p_WCm = body.X_WB * inertia.p_BCm + time * body.v_WCm + 0.5 * time * time * acceleration;
  const Quat& q_WB = rotations_[i].q_WB;
  return {p_WCm - q_WB * inertia.p_BCm, q_WB};
}

}  // namespace presa
