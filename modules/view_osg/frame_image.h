#pragma once
#include <osg/Camera>
#include <osg/Image>
#include <string>

namespace presa::view {

/// Copies the finished frame out of the frame buffer that is read at present, on request.
class FrameGrabber : public osg::Camera::DrawCallback {
 public:
  /// Captures the next frame.
  void arm() { armed_ = true; }
  /// The captured frame, RGB; null if there is none.
  osg::ref_ptr<osg::Image> take();
  void operator()(osg::RenderInfo& info) const override;

 private:
  mutable bool armed_ = false;
  mutable osg::ref_ptr<osg::Image> image_;
};

/// RGB image in which each pixel is the mean of factor x factor pixels, averaged in linear light rather than in sRGB
/// codes.
osg::ref_ptr<osg::Image> shrink(osg::Image& image, int factor);

/// RGBA image without its background, from the same frame over black and over white.
osg::ref_ptr<osg::Image> cutOut(const osg::Image& over_black, const osg::Image& over_white);

/// Returns "" on success, else the reason for the failure.
std::string writePng(const osg::Image& image, const std::string& file);

}  // namespace presa::view
