#include "framework/geometry/tangent_frame.h"

#include <cmath>

namespace presa {

Pose tangentFrame(const Vec3& nhat_B, const Vec3& p_B) noexcept {
  constexpr double kAcross = 0.99;  // cosine
  const Vec3 axis = std::abs(nhat_B.x()) > kAcross ? Vec3::UnitY() : Vec3::UnitX();
  Mat3 R_BT;
  R_BT.col(0) = (axis - axis.dot(nhat_B) * nhat_B).normalized();
  R_BT.col(1) = nhat_B.cross(R_BT.col(0));
  R_BT.col(2) = nhat_B;
  return {nhat_B.dot(p_B) * nhat_B, Quat(R_BT)};
}

}  // namespace presa
