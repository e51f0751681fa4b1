#pragma once
#include <memory>
#include <osg/Image>

#include "modules/view_osg/picture.h"
#include "modules/view_osg/window_input.h"

namespace presa::view {

/// Where a picture is shown. All calls on the thread that made it.
class Renderer {
 public:
  virtual ~Renderer() = default;
  /// Draws the picture as it is now; handles the user's input first.
  virtual void render() = 0;
  /// Draws and returns the frame, RGB.
  virtual osg::ref_ptr<osg::Image> capture() = 0;
  /// The user is done with it: window closed or Esc. Drawing does nothing from then on.
  virtual bool closed() const = 0;
  /// The user asked for a picture since the last call.
  virtual bool takePictureRequest() = 0;
  virtual Inputs inputs() const { return {}; }
  /// As View::sharpness.
  virtual double sharpness() const { return 1; }
};

/// Without a display: 1280 x 720, drawn at twice the size and averaged down.
std::unique_ptr<Renderer> makeOffscreenRenderer(Picture& picture);
/// On the display that DISPLAY names. What `controls` name must outlive it. Throws std::runtime_error when there is no display.
std::unique_ptr<Renderer> makeWindowRenderer(Picture& picture, const std::string& title, const Controls& controls);

}  // namespace presa::view
