#include "modules/view_osg/window_context.h"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

namespace presa::view {
namespace {

osg::ref_ptr<osg::GraphicsContext> createWindow(const std::string& title, int width, int height, unsigned samples) {
  osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits;
  traits->readDISPLAY();
  unsigned screen_width = 0, screen_height = 0;
  if (auto* system = osg::GraphicsContext::getWindowingSystemInterface())
    system->getScreenResolution(*traits, screen_width, screen_height);
  const WindowPlace place = fitted(width, height, static_cast<int>(screen_width), static_cast<int>(screen_height));
  traits->x = place.x;
  traits->y = place.y;
  traits->width = place.width;
  traits->height = place.height;
  traits->windowDecoration = true;
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

// The plain window stays open until the multisampled one is: an X server resets when its last client leaves, and drops
// clients that connect meanwhile.
WindowContext openWindow(const std::string& title, int width, int height) {
  WindowContext plain{createWindow(title, width, height, 0)};
  if (!plain.context) throw std::runtime_error(whyNoWindow());
  plain.software = isSoftware(*plain.context);
  if (plain.software) return plain;
  const osg::ref_ptr<osg::GraphicsContext> smooth = createWindow(title, width, height, 4);
  if (!smooth || !smooth->realize()) return plain;
  plain.context->close();
  return {smooth, false};
}

WindowContext participantWindow(const std::string& title, int width, int height) {
  static WindowContext* const window = new WindowContext;  // outlives the objects of the graphics library
  if (!window->context || !window->context->isRealized()) *window = openWindow(title, width, height);
  return *window;
}

}  // namespace presa::view
