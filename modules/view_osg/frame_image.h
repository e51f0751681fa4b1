#pragma once
#include <osg/Camera>
#include <osg/Image>
#include <string>

namespace presa::view {

/// Copies the finished frame out of the frame buffer when asked to.
class FrameGrabber : public osg::Camera::DrawCallback {
 public:
  /// The next frame drawn will be kept.
  void arm() { armed_ = true; }
  osg::ref_ptr<osg::Image> take() { return std::exchange(image_, nullptr); }
  void operator()(osg::RenderInfo& info) const override;

 private:
  mutable bool armed_ = false;
  mutable osg::ref_ptr<osg::Image> image_;
};

/// RGB image with each pixel the mean of factor x factor pixels (averaged as light, not as sRGB codes).
osg::ref_ptr<osg::Image> shrink(const osg::Image& image, int factor);

/// Empty on success, else why not.
std::string writePng(const osg::Image& image, const std::string& file);

}  // namespace presa::view
