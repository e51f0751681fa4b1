#pragma once
#include <osg/Matrixd>
#include <osg/Vec3d>
#include <osg/Vec4>

#include "framework/core/math/spatial.h"

namespace presa::view {

inline osg::Vec3d toOsg(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

/// X_AB as OSG wants it: row vectors, so that p_A = p_B * matrix.
osg::Matrixd toOsg(const Pose& X_AB);

/// Takes the z axis to `direction` (any length but zero), the origin to `origin`, after scaling by `scale`.
osg::Matrixd alongZ(const Vec3& origin, const Vec3& direction, const Vec3& scale);

}  // namespace presa::view
