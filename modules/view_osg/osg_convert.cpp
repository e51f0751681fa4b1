#include "modules/view_osg/osg_convert.h"

#include "framework/geometry/rotation_between.h"

namespace presa::view {

osg::Matrixd toOsg(const Pose& X_AB) {
  osg::Matrixd matrix(osg::Quat(X_AB.q.x(), X_AB.q.y(), X_AB.q.z(), X_AB.q.w()));
  matrix.setTrans(toOsg(X_AB.p));
  return matrix;
}

osg::Matrixd alongZ(const Vec3& origin, const Vec3& direction, const Vec3& scale) {
  const Pose X{origin, rotationBetween(Vec3::UnitZ(), direction)};
  return osg::Matrixd::scale(toOsg(scale)) * toOsg(X);
}

}  // namespace presa::view
