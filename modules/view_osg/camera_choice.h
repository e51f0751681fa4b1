#pragma once
#include <optional>
#include <vector>

#include "framework/scene/picture_options.h"
#include "modules/view_osg/camera.h"

namespace presa::view {

/// From where a picture is seen: from the place or the side that the user asks for, else from a chosen heading.
class CameraChoice {
 public:
  explicit CameraChoice(const PictureOptions& options, double elevation = kElevation)
      : asked_(options.camera), elevation_(elevation) {}
  /// The place that the user asks for; none: the camera follows the subject from `direction`.
  std::optional<CameraPose> place() const;
  struct Direction {
    double heading, elevation;  ///< as of CameraAxes [rad]
  };
  Direction direction(const std::vector<Ball>& subject) const;

 private:
  std::optional<std::variant<ViewSide, CameraPlace>> asked_;
  double elevation_;  // unless a side is asked for [rad]
};

/// What is upwards in the picture of a camera without roll: +z, or +y where it looks straight up or down.
Vec3 upOf(const CameraPose& pose);

}  // namespace presa::view
