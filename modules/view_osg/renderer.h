#pragma once
#include <memory>
#include <osg/Image>

#include "framework/walls/canvas.h"
#include "modules/view_osg/picture.h"
#include "modules/view_osg/window_input.h"

namespace presa::view {

/// Output of a picture. All calls on the thread that created it.
class Renderer {
 public:
  virtual ~Renderer() = default;
  /// Handles the user's input, then draws the picture.
  virtual void render() = 0;
  /// Draws and returns the frame, RGB; RGBA for a transparent background.
  virtual osg::ref_ptr<osg::Image> capture() = 0;
  /// True when the user has closed the window or pressed Esc; drawing then has no effect.
  virtual bool closed() const = 0;
  /// Whether the user has requested a picture since the last call.
  virtual bool takePictureRequest() = 0;
  virtual Inputs inputs() const { return {}; }
  /// See View::sharpness.
  virtual double sharpness() const { return 1; }
};

/// Pictures of a run: one, some, or the many of a film.
enum class Pictures { kOne, kSome, kFilm };
/// Without a display: rendered at twice the size and averaged, a film at 1.5 times, in two thirds of the time; pictures
/// above 4096 pixels as they are. Some and a film are lit as in a window, and only what changed is drawn.
std::unique_ptr<Renderer> makeOffscreenRenderer(Picture& picture, const PictureOptions& options, Pictures pictures);
/// In a window on DISPLAY, at first with the size and the camera of the options. The objects in `controls` must outlive
/// it. Throws std::runtime_error when there is no display.
std::unique_ptr<Renderer> makeWindowRenderer(Picture& picture, const std::string& title, const Controls& controls,
                                             const PictureOptions& options);

/// A wall of a CAVE, in a window of its size or off-screen: the three-dimensional part alone, for the eyes of `canvas`
/// when render() is called. `canvas` must outlive it. Throws std::runtime_error when there is no display.
std::unique_ptr<Renderer> makeWallRenderer(Picture& picture, walls::Canvas& canvas, bool window,
                                           const std::string& title);

}  // namespace presa::view
