#pragma once
#include "modules/view_osg/camera.h"

namespace presa::view {

/// The camera in the user's hand: it turns about a target and never rolls. Lengths of drags are in halves of the picture's height, so
/// that the same drag does the same in any window.
class CameraControl {
 public:
  explicit CameraControl(double aspect) : aspect_(aspect) {}
  void setAspect(double aspect) { aspect_ = aspect; }

  void set(const CameraPose& pose);
  /// A part (0 to 1) of the way to `goal`.
  void approach(const CameraPose& goal, double share);
  /// The scene turns with the mouse.
  void orbit(double right, double up);
  /// What lies at the target stays under the mouse.
  void pan(double right, double up);
  /// Below 1: nearer.
  void zoom(double factor);
  /// Camera and target together, in shares of their distance: to the right, level ahead, up.
  void fly(double right, double ahead, double up);
  /// Looks at a point from where it looks from.
  void center(const Vec3& p_W) { target_ = p_W; }

  CameraPose pose() const;
  CameraAxes axes() const { return {heading_, elevation_}; }
  double elevation() const { return elevation_; }
  /// Metres at `p_W` that half of the picture's height shows.
  double scaleAt(const Vec3& p_W) const;
  /// From the eye through a point of the picture (-1 to 1, to the right and up), unit.
  Vec3 rayThrough(double right, double up) const;

 private:
  double aspect_;
  Vec3 target_ = Vec3::Zero();
  double heading_ = 0, elevation_ = 0, distance_ = 1;
};

}  // namespace presa::view
