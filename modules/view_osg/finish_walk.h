#pragma once
#include "modules/view_osg/camera.h"

namespace presa::view {

/// Once round what was built, when it stands: the camera rests, walks in a circle at its height and its distance, and is
/// back where it began. The first touch ends the walk where it is.
class FinishWalk {
 public:
  static constexpr double kPause = 3, kLap = 36;  ///< before the walk, and once round [s]

  /// `pose` turned by the way walked so far about the vertical axis through `middle`. `seconds`: since completion;
  /// negative: not complete, which makes the next completion walk again. `touches`: a count of inputs.
  CameraPose at(double seconds, unsigned touches, const CameraPose& pose, const Vec3& middle);
  bool walks() const { return walks_; }

 private:
  double angle_ = 0;  // [rad]
  unsigned touches_ = 0;
  bool begun_ = false, stopped_ = false, walks_ = false;
};

}  // namespace presa::view
