#include "experiments/stability/held_body.h"

#include <cmath>

namespace presa::stability {

HeldBody::HeldBody(Parameters parameters, double time, const Pose& X_WB, const Vec3& v_WB, const Vec3& w_WB)
    : parameters_(std::move(parameters)), begin_(time), X_WB_(X_WB), v_(v_WB) {
  L_ = X_WB.q * parameters_.inertia.cwiseProduct(X_WB.q.conjugate() * w_WB);
}

Vec3 HeldBody::angularVelocity() const {
  return X_WB_.q * (X_WB_.q.conjugate() * L_).cwiseQuotient(parameters_.inertia);
}

Vec3 HeldBody::force(std::size_t finger) const {
  return parameters_.stiffness *
         (parameters_.fingertip(finger, time()) - X_WB_.p - X_WB_.q * parameters_.attachments[finger]);
}

double HeldBody::kineticEnergy() const {
  return parameters_.mass * v_.squaredNorm() / 2 + L_.dot(angularVelocity()) / 2;
}

void HeldBody::step() {
  Vec3 total = parameters_.mass * parameters_.gravity, torque = Vec3::Zero();
  for (std::size_t i = 0; i < parameters_.attachments.size(); ++i) {
    const Vec3 arm = X_WB_.q * parameters_.attachments[i];
    const Vec3 f = force(i);
    total += f;
    torque += arm.cross(f);
  }
  v_ += kStep / parameters_.mass * total;
  L_ += kStep * torque;
  X_WB_.p += kStep * v_;
  const Vec3 turn = kStep * angularVelocity();
  const double angle = turn.norm();
  if (angle > 0) X_WB_.q = (Quat(Eigen::AngleAxisd(angle, turn / angle)) * X_WB_.q).normalized();
  ++steps_;
}

void HeldBody::relax(double duration) {
  double before = kineticEnergy();
  for (auto left = std::llround(duration / kStep); left > 0; --left) {
    step();
    const double now = kineticEnergy();
    const bool slower = now < before;
    before = slower ? 0 : now;
    if (slower) v_ = L_ = Vec3::Zero();
  }
}

void HeldBody::advance(double time) {
  const auto wanted = static_cast<std::uint64_t>(std::llround((time - begin_) / kStep));
  while (steps_ < wanted) step();
}

}  // namespace presa::stability
