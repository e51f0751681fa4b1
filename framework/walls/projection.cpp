#include "framework/walls/projection.h"

namespace presa::walls {

bool Frustum::operator==(const Frustum& other) const {
  return X_WE.p == other.X_WE.p && X_WE.q.coeffs() == other.X_WE.q.coeffs() && left == other.left &&
         right == other.right && bottom == other.bottom && top == other.top;
}

std::optional<Frustum> frustumOf(const Walls& walls, const Wall& wall, const Vec3& eye_K) {
  const Vec3 right = (wall.lower_right - wall.lower_left).normalized();
  const Vec3 up = (wall.upper_left - wall.lower_left).normalized();
  const Vec3 to_eye = right.cross(up).normalized();
  const double distance = (eye_K - wall.lower_left).dot(to_eye);
  if (!(distance >= kNearestEye)) return std::nullopt;
  Mat3 R_KE;
  R_KE << right, to_eye.cross(right), to_eye;
  const Vec3 corner = wall.lower_left - eye_K;
  Frustum frustum;
  frustum.X_WE = walls.X_WK * Pose{eye_K / walls.magnification, Quat(R_KE)};
  frustum.left = corner.dot(right) / distance;
  frustum.right = (wall.lower_right - eye_K).dot(right) / distance;
  frustum.bottom = corner.dot(up) / distance;
  frustum.top = (wall.upper_left - eye_K).dot(up) / distance;
  return frustum;
}

std::array<Vec3, 2> eyesOf(const Walls& walls, const Pose& X_KHead) {
  const Vec3 right(walls.eye_distance / 2, 0, 0);
  return {X_KHead * Vec3(-right), X_KHead * right};
}

Eigen::Vector2d inPicture(const Frustum& frustum, const Vec3& p_W) {
  const Vec3 p_E = frustum.X_WE.inverseTimes(p_W);
  return {(-p_E.x() / p_E.z() - frustum.left) / (frustum.right - frustum.left),
          (-p_E.y() / p_E.z() - frustum.bottom) / (frustum.top - frustum.bottom)};
}

Eigen::Matrix4d projectionOf(const Frustum& frustum, double near, double far) {
  const double width = frustum.right - frustum.left, height = frustum.top - frustum.bottom;
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
  matrix(0, 0) = 2 / width;
  matrix(0, 2) = (frustum.right + frustum.left) / width;
  matrix(1, 1) = 2 / height;
  matrix(1, 2) = (frustum.top + frustum.bottom) / height;
  matrix(2, 2) = -(far + near) / (far - near);
  matrix(2, 3) = -2 * far * near / (far - near);
  matrix(3, 2) = -1;
  return matrix;
}

}  // namespace presa::walls
