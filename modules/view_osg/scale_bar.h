#pragma once
#include <optional>
#include <osg/Group>
#include <osg/MatrixTransform>

#include "modules/view_osg/camera.h"
#include "modules/view_osg/hud_widgets.h"
#include "modules/view_osg/ink.h"

namespace presa::view {

/// A bar of round length at the lower left, true at the distance of the camera's target (nearer things look longer).
class ScaleBar {
 public:
  /// `left`: group whose x = 0 is the left edge.
  ScaleBar(osg::Group& left, const Ink& ink);
  void update(const CameraPose& pose);

 private:
  osg::ref_ptr<osg::MatrixTransform> middle_ = new osg::MatrixTransform, end_ = new osg::MatrixTransform;
  std::optional<Label> length_;
};

/// Length of that bar: the longest of 1, 2 and 5 times a power of ten that is at most `longest` [m].
double roundLength(double longest);

}  // namespace presa::view
