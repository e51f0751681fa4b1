#pragma once
#include <vector>

#include "framework/core/math/spatial.h"

namespace presa::view {

/// What must be in the picture.
struct Ball {
  Vec3 center = Vec3::Zero();
  double radius = 0;
};

struct CameraPose {
  Vec3 eye = Vec3::Zero();
  Vec3 target = Vec3::Zero();
};

inline constexpr double kFieldOfView = 28;  ///< vertical [degree]

/// Unit vectors of a camera that looks from `heading` (below) and from `elevation` above the horizon [rad].
struct CameraAxes {
  CameraAxes(double heading, double elevation);
  Vec3 right, up, forward;
};

/// One ball around all (not the smallest: centred on their box). Radius at least 2 cm.
Ball enclose(const std::vector<Ball>& balls);

/// Where to look from, as an angle from the front (-y) to the right (+x) [rad]: of 12 and 78 degrees the one that shows the
/// balls' centres further apart, so that opposed fingers do not hide behind the object.
double chooseHeading(const std::vector<Ball>& balls);

/// Share of the picture's width for the subject: between the cards of the head-up display, and where there are none.
inline constexpr double kBetweenCards = 0.52, kWholeWidth = 0.88;

/// View from `heading` and above: the nearest that holds every ball in its picture, within `used_width` of it,
/// and with as much room on either side of what is outermost. Not nearer than to see 2 cm.
CameraPose frameSubject(const std::vector<Ball>& balls, double aspect, double heading,
                        double used_width = kBetweenCards);

}  // namespace presa::view
