#pragma once
#include <optional>
#include <osg/Group>

#include "framework/session/view.h"
#include "modules/view_osg/hud_widgets.h"

namespace presa::view {

/// How time goes, where the user has a say in it: held or at which speed, and in a recording a bar to move about in.
class TimeBar {
 public:
  /// `center`: origin in the middle of a picture of 720 lines, `bottom` in its coordinates.
  TimeBar(osg::Group& center, float bottom) : center_(center), bottom_(bottom) {}
  /// `length` of the recording [s]; 0: no bar. `wish` outlives this.
  void offer(const TimeWish& wish, double length);
  void update(double time);
  /// The moment under a point of the picture, in halves of its height from the middle; none: beside the bar.
  std::optional<double> momentAt(double right, double up, bool wherever_up = false) const;
  double time() const { return time_; }
  double length() const { return length_; }

 private:
  osg::Group& center_;
  const float bottom_;
  const TimeWish* wish_ = nullptr;
  double length_ = 0, time_ = 0;
  std::optional<Bar> bar_;
  std::optional<Label> pace_;
};

}  // namespace presa::view
