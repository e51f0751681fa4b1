#pragma once
#include <osg/Node>

#include "framework/core/math/spatial.h"

namespace presa::view {

/// Land around a floor out of doors, which continues it without an edge: a cape with the sea on the side that a visitor
/// looks to (+y), hills to the left and behind. `middle`, `radius`: of the floor; `ground`: its height [m].
osg::ref_ptr<osg::Node> makeLandscape(const Vec3& middle, double radius, double ground);

/// Height of that land over the floor, in radii of the floor, at the distance `r` (1: the floor's edge) and the angle
/// `turn` from +y to the left [rad].
double landHeight(double r, double turn);

}  // namespace presa::view
