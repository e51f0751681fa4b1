#include <osgGA/GUIEventHandler>
#include <osgGA/OrbitManipulator>
#include <osgViewer/Viewer>
#include <stdexcept>

#include "modules/view_osg/frame_image.h"
#include "modules/view_osg/osg_convert.h"
#include "modules/view_osg/renderer.h"

namespace presa::view {
namespace {

constexpr int kWidth = 1280, kHeight = 720;

/// Keys of the window. First in line, so that the space bar does not reach the manipulator (which would jump home).
class Keys : public osgGA::GUIEventHandler {
 public:
  explicit Keys(Picture& picture) : picture_(picture) {}
  bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter&) override {
    if (event.getEventType() == osgGA::GUIEventAdapter::RESIZE) {
      picture_.setSize(event.getWindowWidth(), event.getWindowHeight());
      return false;
    }
    if (event.getEventType() != osgGA::GUIEventAdapter::KEYDOWN) return false;
    switch (event.getKey()) {
      case 's': picture_requested = true; return true;
      case 'h': frame_requested = true; return true;
      case '?': picture_.hud().toggleHelp(); return true;
      case osgGA::GUIEventAdapter::KEY_Space: return true;
      default: return false;
    }
  }
  bool picture_requested = false;
  bool frame_requested = true;  ///< the first frame frames

 private:
  Picture& picture_;
};

osg::ref_ptr<osg::GraphicsContext> openWindow(const std::string& title) {
  osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits;
  traits->readDISPLAY();
  traits->x = traits->y = 40;
  traits->width = kWidth;
  traits->height = kHeight;
  traits->windowDecoration = true;
  traits->doubleBuffer = true;
  traits->depth = 24;
  traits->samples = 4;
  traits->windowName = title;
  osg::ref_ptr<osg::GraphicsContext> window = osg::GraphicsContext::createGraphicsContext(traits);
  if (!window || !window->valid()) {
    traits->samples = 0;  // not every X server has a multisampled visual
    window = osg::GraphicsContext::createGraphicsContext(traits);
  }
  if (!window || !window->valid()) throw std::runtime_error("no window can be opened on display '" + traits->displayName() + "'");
  return window;
}

class WindowRenderer final : public Renderer {
 public:
  WindowRenderer(Picture& picture, const std::string& title) : picture_(picture), window_(openWindow(title)), keys_(new Keys(picture)) {
    viewer_.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
    viewer_.setLightingMode(osg::View::NO_LIGHT);
    viewer_.setKeyEventSetsDone(osgGA::GUIEventAdapter::KEY_Escape);
    osg::Camera* camera = viewer_.getCamera();
    camera->setGraphicsContext(window_);
    camera->setViewport(0, 0, kWidth, kHeight);
    camera->setProjectionMatrixAsPerspective(kFieldOfView, static_cast<double>(kWidth) / kHeight, 0.01, 10);
    camera->setFinalDrawCallback(grabber_);
    viewer_.addEventHandler(keys_);
    viewer_.setCameraManipulator(orbit_, false);
    viewer_.setSceneData(picture.root());
    orbit_->setVerticalAxisFixed(true);
    picture.setSize(kWidth, kHeight);
    viewer_.realize();
    if (!viewer_.isRealized()) throw std::runtime_error("the window opened, but it gives no OpenGL context");
  }

  ~WindowRenderer() override {
    viewer_.setSceneData(nullptr);
    if (window_->valid()) window_->close();
  }

  void render() override {
    if (closed()) return;
    if (keys_->frame_requested) frameAgain();
    viewer_.frame();
  }
  osg::ref_ptr<osg::Image> capture() override {
    if (closed()) return nullptr;
    grabber_->arm();
    render();
    return grabber_->take();
  }
  bool closed() const override { return viewer_.done() || !window_->isRealized(); }
  bool takePictureRequest() override { return std::exchange(keys_->picture_requested, false); }

 private:
  void frameAgain() {
    keys_->frame_requested = false;
    const osg::Viewport* port = viewer_.getCamera()->getViewport();
    const CameraPose pose = frameSubject(picture_.subject(), port->aspectRatio());
    orbit_->setTransformation(toOsg(pose.eye), toOsg(pose.target), {0, 0, 1});
  }

  Picture& picture_;
  osg::ref_ptr<osg::GraphicsContext> window_;
  osg::ref_ptr<Keys> keys_;
  osg::ref_ptr<osgGA::OrbitManipulator> orbit_ = new osgGA::OrbitManipulator;
  osg::ref_ptr<FrameGrabber> grabber_ = new FrameGrabber;
  osgViewer::Viewer viewer_;
};

}  // namespace

std::unique_ptr<Renderer> makeWindowRenderer(Picture& picture, const std::string& title) {
  return std::make_unique<WindowRenderer>(picture, title);
}

}  // namespace presa::view
