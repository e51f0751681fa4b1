#pragma once
#include <osg/Geometry>
#include <vector>

#include "framework/scene/scene.h"
#include "modules/view_osg/crease_normals.h"

/// Drawable surfaces in the geometry's own frame. Primitives are tessellated from their exact parameters, with the
/// normals of the true surface.
namespace presa::view {

/// Number of flat pieces of round surfaces.
struct Roundness {
  int around;  ///< per full turn
  int arc;     ///< per quarter circle of a profile
};
inline constexpr Roundness kFine{96, 32};
inline constexpr Roundness kQuick{48, 12};  ///< for software rendering

/// A point of a profile that is revolved about z: radius and height, and its outward normal.
struct ProfilePoint {
  double r, z;    ///< [m]
  double nr, nz;  ///< unit
};
/// Surface of revolution. Consecutive points are joined; repeat a point with another normal for an edge. From low to
/// high z.
osg::ref_ptr<osg::Geometry> revolve(const std::vector<ProfilePoint>& profile, const Vec3& color,
                                    const Roundness& round = kFine);

osg::ref_ptr<osg::Geometry> boxGeometry(const Vec3& size, const Vec3& color);
osg::ref_ptr<osg::Geometry> sphereGeometry(double radius, const Vec3& color, const Roundness& round = kFine);
osg::ref_ptr<osg::Geometry> cylinderGeometry(double radius, double length, const Vec3& color,
                                             const Roundness& round = kFine);
osg::ref_ptr<osg::Geometry> capsuleGeometry(double radius, double length, const Vec3& color,
                                            const Roundness& round = kFine);
osg::ref_ptr<osg::Geometry> meshGeometry(const ShadedMesh& mesh, const Vec3& color);

/// Radius 1, from z = 0 to z = 1: closed shaft, and cone with its base at 0 and tip at 1; scale into place.
osg::ref_ptr<osg::Geometry> unitShaft(const Vec3& color, const Roundness& round = kFine);
osg::ref_ptr<osg::Geometry> unitConeUp(const Vec3& color, const Roundness& round = kFine);
/// Friction cone: tip at z = 0, rim of radius 1 at z = 1, open.
osg::ref_ptr<osg::Geometry> unitFrictionCone(const Vec3& color, const Roundness& round = kFine);
/// Thin band along the rim of that cone.
osg::ref_ptr<osg::Geometry> unitRim(const Vec3& color, const Roundness& round = kFine);

}  // namespace presa::view
