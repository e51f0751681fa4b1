#pragma once
#include <osg/Camera>
#include <osg/Geometry>
#include <osg/Group>
#include <osg/Texture2D>

#include "modules/view_osg/picture.h"

namespace presa::view {

/// A picture whose three-dimensional part is drawn into fewer pixels than the window has and spread over it; the head-up display
/// lies over it at full size. For a processor that draws: its time goes into pixels.
class CoarseSpace {
 public:
  /// `picture` must outlive this.
  explicit CoarseSpace(Picture& picture);
  /// What to draw instead of the picture's own root.
  osg::Group* root() { return root_; }
  /// Size of the window [pixel], and the share of its width and height that is drawn; 1: straight into the window.
  void setSize(int width, int height, double share);

 private:
  Picture& picture_;
  osg::ref_ptr<osg::Group> root_ = new osg::Group;
  osg::ref_ptr<osg::Camera> camera_ = new osg::Camera;
  osg::ref_ptr<osg::Texture2D> texture_ = new osg::Texture2D;
  osg::ref_ptr<osg::Geometry> screen_;
};

}  // namespace presa::view
