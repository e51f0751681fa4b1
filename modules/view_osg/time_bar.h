#pragma once
#include <optional>
#include <osg/Group>

#include "framework/session/view.h"
#include "modules/view_osg/hud_widgets.h"

namespace presa::view {

/// Time control: held or speed of a run, and in a recording a bar to move about in, with its moment and its end.
class TimeBar {
 public:
  /// `center`: origin in the middle of a picture of 720 lines, `bottom` in its coordinates.
  TimeBar(osg::Group& center, float bottom) : center_(center), bottom_(bottom) {}
  /// `length`: duration of the recording [s]; 0: no bar. `time_control` must outlive this. Not `drawn`: only keys.
  void offer(const TimeControl& time_control, double length, bool drawn = true);
  void update(double time);
  /// The moment at a point of the picture, in halves of its height from the middle; none: the point is off the bar.
  std::optional<double> momentAt(double right, double up, bool wherever_up = false) const;
  double time() const { return time_; }
  double length() const { return length_; }

 private:
  osg::Group& center_;
  const float bottom_;
  const TimeControl* time_control_ = nullptr;
  double length_ = 0, time_ = 0;
  std::optional<Bar> bar_;
  std::optional<Label> pace_, now_, end_;
};

}  // namespace presa::view
