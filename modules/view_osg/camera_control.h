#pragma once
#include <numbers>
#include <optional>

#include "modules/view_osg/camera.h"

namespace presa::view {

/// Manual camera: orbits a target and never rolls. Drags are measured in halves of the picture's height, so that they
/// have the same effect in any window.
class CameraControl {
 public:
  /// Largest elevation [rad]: looking straight down leaves right and left undefined.
  static constexpr double kSteepest = 89 * std::numbers::pi / 180;
  explicit CameraControl(double aspect) : aspect_(aspect) {}
  void setAspect(double aspect) { aspect_ = aspect; }
  /// The eye stays above this height, whatever moves it [m]; none: anywhere.
  void setGround(std::optional<double> z) { ground_ = z; }
  static constexpr double kAboveGround = 0.03;  ///< [m]

  void set(const CameraPose& pose);
  /// Orbits the target; the scene turns with the mouse.
  void orbit(double right, double up);
  /// Pans; the target plane stays under the mouse.
  void pan(double right, double up);
  /// Scales the distance to the target; below 1: nearer.
  void zoom(double factor);
  /// Moves camera and target together, in fractions of their distance: right, level ahead, up.
  void fly(double right, double ahead, double up);
  /// Sets the target without changing the direction of view.
  void center(const Vec3& p_W) { target_ = p_W; }

  CameraPose pose() const;
  CameraAxes axes() const { return {heading_, elevation_}; }
  double elevation() const { return elevation_; }
  /// Length at `p_W` that corresponds to half of the picture's height [m].
  double scaleAt(const Vec3& p_W) const;
  /// Unit vector from the eye through a point of the picture (-1 to 1, right and up).
  Vec3 rayThrough(double right, double up) const;

 private:
  void stayAbove();

  double aspect_;
  Vec3 target_ = Vec3::Zero();
  double heading_ = 0, elevation_ = 0, distance_ = 1;
  std::optional<double> ground_;
};

}  // namespace presa::view
