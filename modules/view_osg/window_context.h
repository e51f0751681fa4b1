#pragma once
#include <osg/GraphicsContext>
#include <string>

namespace presa::view {

struct WindowContext {
  osg::ref_ptr<osg::GraphicsContext> context;
  bool software = false;  ///< drawn by the processor
};

/// A decorated window on the display of the environment, with smooth edges where a graphics card pays for them and the X server
/// has such a visual. Throws std::runtime_error that says why there is none.
WindowContext openWindow(const std::string& title, int width, int height);

}  // namespace presa::view
