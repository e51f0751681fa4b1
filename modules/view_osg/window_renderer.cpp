#include <cmath>
#include <osgGA/GUIEventHandler>
#include <osgGA/OrbitManipulator>
#include <osgViewer/Viewer>
#include <stdexcept>

#include "modules/view_osg/frame_image.h"
#include "modules/view_osg/osg_convert.h"
#include "modules/view_osg/renderer.h"
#include "modules/view_osg/window_context.h"

namespace presa::view {
namespace {

constexpr int kWidth = 1280, kHeight = 720;
constexpr double kFollowTime = 0.4;  ///< time constant of the camera [s]

/// Keys of the window. First in line, so that the space bar does not reach the manipulator (which would jump home).
class Keys : public osgGA::GUIEventHandler {
 public:
  explicit Keys(Picture& picture) : picture_(picture) {}
  bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter&) override {
    if (event.getEventType() == osgGA::GUIEventAdapter::RESIZE) {
      picture_.setSize(event.getWindowWidth(), event.getWindowHeight());
      return false;
    }
    if (event.getEventType() == osgGA::GUIEventAdapter::PUSH || event.getEventType() == osgGA::GUIEventAdapter::SCROLL)
      following = false;
    if (event.getEventType() == osgGA::GUIEventAdapter::PUSH) ++inputs.all;
    if (event.getEventType() != osgGA::GUIEventAdapter::KEYDOWN) return false;
    ++inputs.all;
    switch (event.getKey()) {
      case 's':
        picture_requested = true;
        return true;
      case 'h':
        frame_requested = following = true;
        return true;
      case 'u':
        ++inputs.undos;
        return true;
      case '?':
        picture_.hud().toggleHelp();
        return true;
      case osgGA::GUIEventAdapter::KEY_Space:
        return true;
      default:
        return false;
    }
  }
  bool picture_requested = false;
  Renderer::Inputs inputs;
  bool frame_requested = true;  ///< the first frame frames
  bool following = true;        ///< until the user takes the camera in hand

 private:
  Picture& picture_;
};

class WindowRenderer final : public Renderer {
 public:
  WindowRenderer(Picture& picture, const std::string& title) : picture_(picture), keys_(new Keys(picture)) {
    const WindowContext window = openWindow(title, kWidth, kHeight);
    window_ = window.context;
    if (window.software) picture.lighting().setQuality(kQuickLight);
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
    orbit_->setAllowThrow(false);  // a quick drag must not leave the scene spinning
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
    if (keys_->following) follow();
    viewer_.frame();
  }
  osg::ref_ptr<osg::Image> capture() override {
    if (closed()) return nullptr;
    grabber_->arm();
    render();
    return grabber_->take();
  }
  bool closed() const override { return viewer_.done() || !window_->isRealized(); }
  Inputs inputs() const override { return keys_->inputs; }
  bool takePictureRequest() override { return std::exchange(keys_->picture_requested, false); }

 private:
  /// Keeps bodies and fingers in the picture, gently; at once when asked for.
  void follow() {
    const double now = viewer_.elapsedTime();
    double share = 1 - std::exp(-(now - followed_at_) / kFollowTime);
    followed_at_ = now;
    if (std::exchange(keys_->frame_requested, false)) {
      heading_ = chooseHeading(picture_.subject());
      share = 1;
    }
    const CameraPose goal =
        frameSubject(picture_.subject(), viewer_.getCamera()->getViewport()->aspectRatio(), heading_);
    camera_.eye += share * (goal.eye - camera_.eye);
    camera_.target += share * (goal.target - camera_.target);
    orbit_->setTransformation(toOsg(camera_.eye), toOsg(camera_.target), {0, 0, 1});
  }

  Picture& picture_;
  osg::ref_ptr<osg::GraphicsContext> window_;
  osg::ref_ptr<Keys> keys_;
  CameraPose camera_;
  double heading_ = 0;
  double followed_at_ = 0;
  osg::ref_ptr<osgGA::OrbitManipulator> orbit_ = new osgGA::OrbitManipulator;
  osg::ref_ptr<FrameGrabber> grabber_ = new FrameGrabber;
  osgViewer::Viewer viewer_;
};

}  // namespace

std::unique_ptr<Renderer> makeWindowRenderer(Picture& picture, const std::string& title) {
  return std::make_unique<WindowRenderer>(picture, title);
}

}  // namespace presa::view
