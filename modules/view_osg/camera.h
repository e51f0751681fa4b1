#pragma once
#include <numbers>
#include <vector>

#include "framework/core/math/spatial.h"

namespace presa::view {

/// A sphere that must be in the picture.
struct Ball {
  Vec3 center = Vec3::Zero();
  double radius = 0;
};

struct CameraPose {
  Vec3 eye = Vec3::Zero();
  Vec3 target = Vec3::Zero();
};

inline constexpr double kFieldOfView = 28;                         ///< vertical [deg]
inline constexpr double kElevation = 26 * std::numbers::pi / 180;  ///< unless another is asked for [rad]
/// Out of doors: the line of sight is nearly level, and the horizon is in the upper part of the picture. The eye is as
/// high as the top of what is built, so that what lies on the ground is seen from some 17 degrees above.
inline constexpr double kEyeLevel = 8 * std::numbers::pi / 180;  ///< [rad]

/// Axes of a camera that looks from `heading` (see chooseHeading) and from `elevation` above the horizon [rad].
struct CameraAxes {
  CameraAxes(double heading, double elevation);
  Vec3 right, up, forward;
};

/// A sphere around all balls, centred on their bounding box (not the smallest sphere). Radius at least 2 cm.
Ball enclose(const std::vector<Ball>& balls);

/// Viewing direction as an angle from the front (-y) to the right (+x) [rad]: 12 or 78 degrees, whichever separates the
/// balls' centres more, so that opposed fingers are not hidden behind the object.
double chooseHeading(const std::vector<Ball>& balls);

/// Fraction of the picture's width for the subject: between the cards of the head-up display, and without cards.
inline constexpr double kBetweenCards = 0.52, kWholeWidth = 0.88;

/// Nearest view from `heading` and `elevation` that shows every ball within `used_width` of the picture, with equal margins
/// on either side. Not nearer than a view of 2 cm.
CameraPose frameSubject(const std::vector<Ball>& balls, double aspect, double heading,
                        double used_width = kBetweenCards, double elevation = kElevation);

/// How far the balls reach from the middle of the picture, relative to the area in which frameSubject places them: 1 if
/// they fill it, more if one of them lies beyond it or behind the eye.
double reachInPicture(const std::vector<Ball>& balls, const CameraPose& pose, double aspect, double used_width);

}  // namespace presa::view
