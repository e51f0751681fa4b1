#pragma once
#include <array>
#include <optional>

#include "framework/walls/walls.h"

namespace presa::walls {

/// Nearest place of an eye before a wall [m]; nearer or behind, the wall shows nothing sensible.
inline constexpr double kNearestEye = 0.01;

/// What an eye sees through a rectangle [Kooima2009, generalised perspective projection]: an off-axis pyramid.
struct Frustum {
  Pose X_WE;  ///< frame of the eye: x along the wall's lower edge, y up along its left edge, z from the wall to the eye
  double left = 0, right = 0, bottom = 0, top = 0;  ///< edges of the wall at distance 1 before the eye [-]
  bool operator==(const Frustum& other) const;
};

/// The frustum in the scene's world of an eye in K; none when it is behind the wall or nearer than kNearestEye.
std::optional<Frustum> frustumOf(const Walls& walls, const Wall& wall, const Vec3& eye_K);

/// Left and right eye of a head, in K.
std::array<Vec3, 2> eyesOf(const Walls& walls, const Pose& X_KHead);

/// Where a point of the world is in the picture: 0 0 at its lower left corner, 1 1 at the upper right one. The point
/// is before the eye.
Eigen::Vector2d inPicture(const Frustum& frustum, const Vec3& p_W);

/// The projection of OpenGL for the frustum: coordinates of the eye to clip space, as a matrix for column vectors.
Eigen::Matrix4d projectionOf(const Frustum& frustum, double near, double far);

}  // namespace presa::walls
