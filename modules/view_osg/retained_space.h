#pragma once
#include <osg/Camera>
#include <osg/Geometry>
#include <osg/Group>
#include <osg/Texture2D>
#include <osg/Uniform>
#include <vector>

#include "modules/view_osg/frame_image.h"
#include "modules/view_osg/picture.h"

namespace presa::view {

/// For software rendering, whose time depends on the number of pixels: keeps the pictures of the three-dimensional part,
/// of the head-up display, and of both together from frame to frame, and draws only the rectangle that changed. While
/// even that takes too long, the three-dimensional part is drawn into fewer pixels.
class RetainedSpace {
 public:
  /// `picture` must outlive this. Frames are copied to the window, or go to the `grabber` where there is none.
  explicit RetainedSpace(Picture& picture, osg::ref_ptr<FrameGrabber> grabber = nullptr);
  /// The node to draw in place of the picture's own root.
  osg::Group* root() { return root_; }
  /// Size of the window [pixel] and drawn fraction of its width and height; once above 1 (at most 2, averaged), it stays
  /// above 1.
  void setSize(int width, int height, double share);
  /// Grey of what no part of the picture covers, 0 to 1.
  void clearTo(float grey);
  /// Prepares the next frame, seen through `view_projection`, at a time of the clock [s]. `now`: the head-up display is
  /// drawn, too, even if it was drawn a moment ago.
  void prepare(const osg::Matrixd& view_projection, double clock, bool now);

 private:
  PixelRect drawSpace(const osg::Matrixd& view_projection);
  std::vector<PixelRect> hudParts();
  PixelRect inWindow(const PixelRect& drawn) const;
  void combine(const std::vector<PixelRect>& parts);

  Picture& picture_;
  osg::ref_ptr<osg::Group> root_ = new osg::Group;
  osg::ref_ptr<osg::Camera> camera_ = new osg::Camera, both_ = new osg::Camera;
  osg::ref_ptr<osg::Texture2D> space_ = new osg::Texture2D, hud_ = new osg::Texture2D, window_ = new osg::Texture2D;
  osg::ref_ptr<osg::Uniform> crop_ = new osg::Uniform("crop", osg::Vec2(0, 1));
  osg::ref_ptr<osg::Geometry> sheets_ = new osg::Geometry;  // the rectangles where both are put together
  osg::ref_ptr<osg::Drawable> copy_;
  std::vector<PixelRect> hud_parts_;  // of the window, where the last head-up display was
  Changes pending_;
  osg::Matrixd view_projection_;
  int width_ = 0, height_ = 0;  // of the three-dimensional part [pixel]
  double share_ = 1;            // of its size in that of the window
  double hud_drawn_ = -1e300;   // [s]
};

}  // namespace presa::view
