#include "modules/pointshell/tool_mass.h"

#include <stdexcept>

namespace presa {

ToolMass::ToolMass(double mass, const TriMesh& mesh) : mass_(mass) {
  const MassProperties solid = massProperties(mesh);
  if (!(solid.volume > 0))
    throw std::invalid_argument(
        "a tool's mesh has no volume, and a tool with mass needs one: thicken it, or mass=\"0\"");
  centre_T_ = solid.center;
  inertia_T_ = mass / solid.volume * solid.inertia;
}

void ToolMass::start(const Pose& X_WT, const Vec3& v_W, const Vec3& w_W) noexcept {
  const Mat3 R = X_WT.q.toRotationMatrix();
  X_WT_ = X_WT;
  v_W_ = v_W + w_W.cross(R * centre_T_);
  momentum_W_ = R * (inertia_T_ * (R.transpose() * w_W));
}

Vec3 ToolMass::momentumAt(const Pose& X_WT, double period) const noexcept {
  const Mat3 R = X_WT.q.toRotationMatrix();
  return R * (inertia_T_ * (R.transpose() * turnBetween(X_WT_.q, X_WT.q))) / period;
}

Vec6 ToolMass::wrench(const Pose& X_WT, double period, Mat6& stiffness) const noexcept {
  const double per_square = 1 / (period * period);
  const Mat3 R_TW = X_WT.q.conjugate().toRotationMatrix();
  const Vec3 v_W = (X_WT * centre_T_ - X_WT_ * centre_T_) / period;
  const Vec3 f_T = R_TW * (-mass_ / period * (v_W - v_W_));
  Vec6 wrench;
  wrench << f_T, centre_T_.cross(f_T) - R_TW * ((momentumAt(X_WT, period) - momentum_W_) / period);
  addStiffness(mass_ * per_square * Mat3::Identity(), centre_T_, stiffness);
  stiffness.bottomRightCorner<3, 3>() += per_square * inertia_T_;
  return wrench;
}

void ToolMass::finish(const Pose& X_WT, double period) noexcept {
  v_W_ = (X_WT * centre_T_ - X_WT_ * centre_T_) / period;
  momentum_W_ = momentumAt(X_WT, period);
  X_WT_ = X_WT;
}

}  // namespace presa
