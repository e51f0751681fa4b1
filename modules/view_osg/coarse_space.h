#pragma once
#include <osg/Camera>
#include <osg/Geometry>
#include <osg/Group>
#include <osg/Texture2D>

#include "modules/view_osg/picture.h"

namespace presa::view {

/// For software rendering, whose time depends on the number of pixels: draws the three-dimensional part into fewer
/// pixels and scales it up to the window; the head-up display is drawn over it at full resolution.
class CoarseSpace {
 public:
  /// `picture` must outlive this.
  explicit CoarseSpace(Picture& picture);
  /// The node to draw in place of the picture's own root.
  osg::Group* root() { return root_; }
  /// Size of the window [pixel] and drawn fraction of its width and height; 1: draw directly into the window.
  void setSize(int width, int height, double share);

 private:
  Picture& picture_;
  osg::ref_ptr<osg::Group> root_ = new osg::Group;
  osg::ref_ptr<osg::Camera> camera_ = new osg::Camera;
  osg::ref_ptr<osg::Texture2D> texture_ = new osg::Texture2D;
  osg::ref_ptr<osg::Geometry> screen_;
};

}  // namespace presa::view
