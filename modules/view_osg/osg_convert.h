#pragma once
#include <osg/Matrixd>
#include <osg/Vec3d>
#include <osg/Vec4>

#include "framework/core/math/spatial.h"

namespace presa::view {

inline osg::Vec3d toOsg(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

/// X_AB in OSG's convention: row vectors, p_A = p_B * matrix.
osg::Matrixd toOsg(const Pose& X_AB);

/// Matrix that scales by `scale`, rotates the z axis to `direction` (any non-zero length), and moves the origin to
/// `origin`.
osg::Matrixd alongZ(const Vec3& origin, const Vec3& direction, const Vec3& scale);

}  // namespace presa::view
