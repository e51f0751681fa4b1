#include "modules/view_osg/window_context.h"

#include <algorithm>
#include <cstdlib>
#include <osgViewer/GraphicsWindow>
#include <stdexcept>
#include <string_view>

namespace presa::view {
namespace {

osg::ref_ptr<osg::GraphicsContext> createWindow(const std::string& title, const WindowPlace& place, unsigned samples,
                                                bool decorated = true, bool quad = false) {
  osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits;
  traits->readDISPLAY();
  traits->x = place.x;
  traits->y = place.y;
  traits->width = place.width;
  traits->height = place.height;
  traits->windowDecoration = decorated;
  traits->quadBufferStereo = quad;
  traits->doubleBuffer = true;
  traits->depth = 24;
  traits->samples = samples;
  traits->windowName = title;
  const osg::ref_ptr<osg::GraphicsContext> window = osg::GraphicsContext::createGraphicsContext(traits);
  return window && window->valid() ? window : nullptr;
}

/// Whether Mesa renders in software.
bool isSoftware(osg::GraphicsContext& window) {
  if (!window.realize() || !window.makeCurrent()) return false;
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  const std::string_view renderer = name ? name : "";
  window.releaseContext();
  return renderer.find("llvmpipe") != renderer.npos || renderer.find("softpipe") != renderer.npos;
}

struct ScreenSize {
  int width = 0, height = 0;
};
/// Of the environment's display. Call while a window is open on it: see openWindow.
ScreenSize screenSize() {
  osg::GraphicsContext::ScreenIdentifier screen;
  screen.readDISPLAY();
  screen.setUndefinedScreenDetailsToDefaultScreen();
  unsigned screen_width = 0, screen_height = 0;
  if (auto* system = osg::GraphicsContext::getWindowingSystemInterface())
    system->getScreenResolution(screen, screen_width, screen_height);
  return {static_cast<int>(screen_width), static_cast<int>(screen_height)};
}

std::string whyNoWindow() {
  const char* display = std::getenv("DISPLAY");
  if (!display) return "DISPLAY is not set";
  osg::GraphicsContext::ScreenIdentifier screen;
  screen.readDISPLAY();
  auto* system = osg::GraphicsContext::getWindowingSystemInterface();
  return (system && system->getNumScreens(screen) > 0 ? "no OpenGL window can be opened on display "
                                                      : "no X server answers on display ") +
         std::string(display);
}

}  // namespace

WindowPlace fitted(int width, int height, int screen_width, int screen_height) {
  constexpr int kCorner = 40, kTitleBar = 40;
  WindowPlace place{kCorner, kCorner, width, height};
  if (screen_width <= 0 || screen_height <= kTitleBar) return place;
  const double share = std::min(
      {1.0, static_cast<double>(screen_width) / width, static_cast<double>(screen_height - kTitleBar) / height});
  place.width = std::max(1, static_cast<int>(share * width));
  place.height = std::max(1, static_cast<int>(share * height));
  place.x = std::min(kCorner, screen_width - place.width);
  place.y = std::min(kCorner, screen_height - place.height);
  return place;
}

// A window stays open until the next one is, also while the screen is asked for its size: an X server resets when its
// last client leaves, and drops clients that connect meanwhile.
WindowContext openWindow(const std::string& title, int width, int height) {
  const WindowPlace wanted = fitted(width, height, 0, 0);
  WindowContext plain{createWindow(title, wanted, 0)};
  if (!plain.context) throw std::runtime_error(whyNoWindow());
  const ScreenSize screen = screenSize();
  const WindowPlace place = fitted(width, height, screen.width, screen.height);
  if (place != wanted) {
    const osg::ref_ptr<osg::GraphicsContext> smaller = createWindow(title, place, 0);
    if (!smaller) throw std::runtime_error(whyNoWindow());
    plain.context->close();
    plain.context = smaller;
  }
  plain.software = isSoftware(*plain.context);
  if (plain.software) return plain;
  const osg::ref_ptr<osg::GraphicsContext> smooth = createWindow(title, place, 4);
  if (!smooth || !smooth->realize()) return plain;
  plain.context->close();
  return {smooth, false};
}

WindowContext wallWindow(const std::string& title, int width, int height, bool quad) {
  WindowContext wall{createWindow(title, {0, 0, width, height}, 0, true, quad)};
  if (!wall.context && quad) return wall;
  if (!wall.context) throw std::runtime_error(whyNoWindow());
  if (const ScreenSize screen = screenSize(); screen.width == width && screen.height == height) {
    const osg::ref_ptr<osg::GraphicsContext> plain = createWindow(title, {0, 0, width, height}, 0, false, quad);
    if (!plain) throw std::runtime_error(whyNoWindow());
    wall.context->close();
    wall.context = plain;
  }
  wall.software = isSoftware(*wall.context);
  return wall;
}

WindowContext keptWindow(const std::string& title, int width, int height) {
  static WindowContext* const window = new WindowContext;  // outlives the objects of the graphics library
  if (!window->context || !window->context->isRealized())
    *window = openWindow(title, width, height);
  else if (auto* open = dynamic_cast<osgViewer::GraphicsWindow*>(window->context.get()))
    open->setWindowName(title);
  return *window;
}

}  // namespace presa::view
