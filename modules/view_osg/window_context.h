#pragma once
#include <osg/GraphicsContext>
#include <string>

namespace presa::view {

struct WindowContext {
  osg::ref_ptr<osg::GraphicsContext> context;
  bool software = false;  ///< software rendering
};

/// Where a window of this size lies on a screen, in pixels.
struct WindowPlace {
  int x = 0, y = 0, width = 0, height = 0;
  bool operator==(const WindowPlace&) const = default;
};
/// The wanted size, or where the screen has less room (for the window and its title bar) the largest of the same shape.
/// A screen of no size is not known: then the window is as wanted.
WindowPlace fitted(int width, int height, int screen_width, int screen_height);

/// A decorated window on the display of the environment, multisampled if there is a graphics card and the X server has
/// such a visual; smaller than asked where the screen is (fitted). Throws std::runtime_error with the reason. `title` in ASCII: OSG hands it to X as Latin-1.
WindowContext openWindow(const std::string& title, int width, int height);

/// A window of exactly this size, for a wall of a CAVE: without decoration where it fills the screen. `quad`: with left
/// and right buffers; no context where the driver has none. Otherwise as openWindow.
WindowContext wallWindow(const std::string& title, int width, int height, bool quad);

/// The window of this process for run after run: opened at the first call and whenever it was closed. Otherwise it stays
/// open until the process ends, with what was drawn last, and gets the new title. Thread: one at a time.
WindowContext keptWindow(const std::string& title, int width, int height);

}  // namespace presa::view
