#include <osgUtil/RenderBin>
#include <osgViewer/Viewer>
#include <stdexcept>

#include "modules/view_osg/finish_walk.h"
#include "modules/view_osg/follow_camera.h"
#include "modules/view_osg/frame_budget.h"
#include "modules/view_osg/frame_image.h"
#include "modules/view_osg/help_text.h"
#include "modules/view_osg/osg_convert.h"
#include "modules/view_osg/renderer.h"
#include "modules/view_osg/retained_space.h"
#include "modules/view_osg/window_context.h"
#include "modules/view_osg/window_input.h"

namespace presa::view {
namespace {

class WindowRenderer final : public Renderer {
 public:
  WindowRenderer(Picture& picture, const std::string& title, const Controls& controls, const PictureOptions& options)
      : picture_(picture),
        keep_(controls.participant || controls.menu != nullptr),
        follow_(options, picture.elevation()),
        camera_(static_cast<double>(options.width) / options.height),
        input_(new WindowInput(picture, camera_, controls)) {
    const WindowContext window =
        keep_ ? keptWindow(title, options.width, options.height) : openWindow(title, options.width, options.height);
    if (const std::optional<CameraPose> place = follow_.choice().place()) {
      camera_.set(*place);
      input_->following = false;
    }
    camera_.setGround(picture.ground());
    window_ = window.context;
    if (window.software) {
      picture.setQuick(true);
      retained_.emplace(picture);
    }
    // front to back, so that hidden surfaces are not shaded
    osgUtil::RenderBin::setDefaultRenderBinSortMode(osgUtil::RenderBin::SORT_FRONT_TO_BACK);
    viewer_.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
    viewer_.setLightingMode(osg::View::NO_LIGHT);
    viewer_.setKeyEventSetsDone(keep_ ? 0 : static_cast<int>(osgGA::GUIEventAdapter::KEY_Escape));
    osg::Camera* camera = viewer_.getCamera();
    camera->setGraphicsContext(window_);
    const osg::GraphicsContext::Traits& size = *window_->getTraits();
    camera->setViewport(0, 0, size.width, size.height);
    camera->setProjectionMatrixAsPerspective(kFieldOfView, static_cast<double>(size.width) / size.height, 0.01, 10);
    camera->setFinalDrawCallback(grabber_);
    viewer_.addEventHandler(input_);
    viewer_.setSceneData(retained_ ? retained_->root() : picture.root());
    std::vector<std::pair<std::string, std::string>> help;
    if (controls.visitor)
      help = picture.visitorHelp();
    else
      for (const HelpLine& line : helpLines(controls, picture.timeBar().length() > 0))
        help.emplace_back(line.keys, line.what);
    picture.hud().setHelp(help);
    input_->setAspect(static_cast<double>(size.width) / size.height);
    setSize(size.width, size.height, 1);
    viewer_.realize();
    if (!viewer_.isRealized()) throw std::runtime_error("the window opened, but it gives no OpenGL context");
  }

  ~WindowRenderer() override {
    const bool stays = keep_ && !closed();
    if (stays && window_->makeCurrent()) {
      picture_.root()->releaseGLObjects(window_->getState());
      window_->releaseContext();
    }
    viewer_.setSceneData(nullptr);
    if (stays)
      viewer_.getCamera()->setGraphicsContext(nullptr);  // else the viewer closes it
    else if (window_->valid())
      window_->close();
  }

  void render() override {
    if (closed()) return;
    const osg::Timer_t begin = osg::Timer::instance()->tick();
    draw();
    const double seconds = osg::Timer::instance()->delta_s(begin, osg::Timer::instance()->tick());
    if (retained_ && budget_.add(seconds)) setSize(width_, height_, budget_.share());
  }
  osg::ref_ptr<osg::Image> capture() override {
    if (closed()) return nullptr;
    setSize(width_, height_, 1);  // saved pictures have full resolution
    grabber_->arm();
    draw(true);
    setSize(width_, height_, budget_.share());
    return grabber_->take();
  }
  bool closed() const override { return viewer_.done() || input_->stop || !window_->isRealized(); }
  Inputs inputs() const override { return input_->inputs; }
  double sharpness() const override { return budget_.share(); }
  bool takePictureRequest() override { return std::exchange(input_->picture_requested, false); }

 private:
  /// `now`: texts are up to date, too.
  void draw(bool now = false) {
    viewer_.advance();
    viewer_.eventTraversal();
    const osg::Viewport& window = *viewer_.getCamera()->getViewport();
    const int width = static_cast<int>(window.width()), height = static_cast<int>(window.height());
    if (width != width_ || height != height_) setSize(width, height, share_);
    if (input_->following) follow();
    const CameraPose pose = camera_.pose();
    viewer_.getCamera()->setViewMatrixAsLookAt(toOsg(pose.eye), toOsg(pose.target), {0, 0, 1});
    picture_.seenFrom(pose);
    viewer_.updateTraversal();
    const osg::Camera& camera = *viewer_.getCamera();
    if (retained_)
      retained_->prepare(camera.getViewMatrix() * camera.getProjectionMatrix(), viewer_.elapsedTime(), now);
    viewer_.renderingTraversals();
  }
  /// Size of the window, and fraction of the resolution at which bodies are drawn.
  void setSize(int width, int height, double share) {
    width_ = width, height_ = height, share_ = share;
    picture_.hud().setAspect(static_cast<double>(width) / height);
    if (retained_)
      retained_->setSize(width, height, share);
    else
      picture_.setSize(width, height);
  }
  /// Keeps bodies and fingers in the picture.
  void follow() {
    const CameraPose pose =
        follow_.at(viewer_.elapsedTime(), picture_.subject(), viewer_.getCamera()->getViewport()->aspectRatio(),
                   picture_.usedWidth(), std::exchange(input_->frame_requested, false));
    const double finished = picture_.finishedFor();
    camera_.set(finished < 0 ? walk_.at(-1, 0, pose, {})
                             : walk_.at(finished, input_->inputs.all, pose, picture_.middleOfGoals()));
  }

  Picture& picture_;
  const bool keep_;  // the window stays open
  FollowCamera follow_;
  FinishWalk walk_;
  CameraControl camera_;
  osg::ref_ptr<osg::GraphicsContext> window_;
  osg::ref_ptr<WindowInput> input_;
  std::optional<RetainedSpace> retained_;  // only with software rendering
  FrameBudget budget_;
  int width_ = 0, height_ = 0;
  double share_ = 1;
  osg::ref_ptr<FrameGrabber> grabber_ = new FrameGrabber;
  osgViewer::Viewer viewer_;
};

}  // namespace

std::unique_ptr<Renderer> makeWindowRenderer(Picture& picture, const std::string& title, const Controls& controls,
                                             const PictureOptions& options) {
  return std::make_unique<WindowRenderer>(picture, title, controls, options);
}

}  // namespace presa::view
