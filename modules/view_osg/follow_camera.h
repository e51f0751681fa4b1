#pragma once
#include <vector>

#include "modules/view_osg/camera.h"

namespace presa::view {

/// Keeps the subject in the picture and the picture still: the camera rests while everything fits and is large enough,
/// else it glides to a new place.
class FollowCamera {
 public:
  /// Where the camera stands at a time of the clock [s]. `now` frames the subject at once.
  CameraPose at(double clock, const std::vector<Ball>& subject, double aspect, double used_width, bool now);

 private:
  CameraPose glide(double clock) const;

  double heading_ = 0;  // of the view [rad]
  CameraPose from_, to_;
  double left_at_ = -1e300;  // when the glide began [s]
  bool placed_ = false;
};

}  // namespace presa::view
