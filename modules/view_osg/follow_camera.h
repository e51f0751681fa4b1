#pragma once
#include <vector>

#include "modules/view_osg/camera_choice.h"

namespace presa::view {

/// Keeps the subject in the picture and the picture still: the camera rests while everything fits and is large enough,
/// else it glides to a new place.
class FollowCamera {
 public:
  explicit FollowCamera(const PictureOptions& options, double elevation = kElevation) : choice_(options, elevation) {}
  const CameraChoice& choice() const { return choice_; }
  /// Where the camera stands at a time of the clock [s]. `now` frames the subject at once.
  CameraPose at(double clock, const std::vector<Ball>& subject, double aspect, double used_width, bool now);

 private:
  CameraPose glide(double clock) const;
  CameraPose frame(const std::vector<Ball>& subject, double aspect, double used_width) const;

  const CameraChoice choice_;
  CameraChoice::Direction direction_{};
  CameraPose from_, to_;
  double left_at_ = -1e300;  // when the glide began [s]
  bool placed_ = false;
};

}  // namespace presa::view
