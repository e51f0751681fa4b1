#include <algorithm>
#include <osg/GLObjects>
#include <osgViewer/Viewer>

#include "modules/view_osg/camera_choice.h"
#include "modules/view_osg/finish_walk.h"
#include "modules/view_osg/follow_camera.h"
#include "modules/view_osg/frame_image.h"
#include "modules/view_osg/gl_context_egl.h"
#include "modules/view_osg/osg_convert.h"
#include "modules/view_osg/renderer.h"
#include "modules/view_osg/retained_space.h"

namespace presa::view {
namespace {

constexpr int kSmoothed = 4096;  ///< longest side of a picture that is rendered larger than it is [pixel]
constexpr int kLarger = 2;       ///< so many times
constexpr double kVideoLarger = 1.5;

bool isSmoothed(const PictureOptions& options) { return std::max(options.width, options.height) <= kSmoothed; }

class OffscreenRenderer final : public Renderer {
 public:
  OffscreenRenderer(Picture& picture, const PictureOptions& options, Pictures pictures)
      : picture_(picture),
        follow_(options, picture.elevation()),
        background_(options.background),
        supersample_(pictures == Pictures::kOne && isSmoothed(options) ? kLarger : 1),
        aspect_(static_cast<double>(options.width) / options.height),
        context_(supersample_ * options.width, supersample_ * options.height) {
    const int width = supersample_ * options.width, height = supersample_ * options.height;
    window_ = viewer_.setUpViewerAsEmbeddedInWindow(0, 0, width, height);
    viewer_.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
    viewer_.setKeyEventSetsDone(0);
    viewer_.setLightingMode(osg::View::NO_LIGHT);
    if (pictures != Pictures::kOne) {
      picture.setQuick(true);
      retained_.emplace(picture);
      const double larger = pictures == Pictures::kVideo ? kVideoLarger : kLarger;
      retained_->setSize(width, height, isSmoothed(options) ? larger : 1);
    }
    viewer_.setSceneData(root());
    osg::Camera* camera = viewer_.getCamera();
    camera->setFinalDrawCallback(grabber_);
    camera->setProjectionMatrixAsPerspective(kFieldOfView, aspect_, 0.01, 10);
    clearTo(1);  // seen only without a sky
    if (!retained_) picture.setSize(width, height);
    picture.hud().setAspect(aspect_);
    viewer_.realize();
  }

  ~OffscreenRenderer() override {
    context_.makeCurrent();
    const unsigned id = window_->getState()->getContextID();
    root()->releaseGLObjects(window_->getState());
    viewer_.setSceneData(nullptr);
    osg::deleteAllGLObjects(id);
  }

  void render() override {
    const CameraPose pose = cameraNow();
    osg::Camera& camera = *viewer_.getCamera();
    camera.setViewMatrixAsLookAt(toOsg(pose.eye), toOsg(pose.target), toOsg(upOf(pose)));
    picture_.seenFrom(pose);
    if (retained_) retained_->prepare(camera.getViewMatrix() * camera.getProjectionMatrix(), picture_.time(), true);
    viewer_.frame();
  }
  osg::ref_ptr<osg::Image> capture() override {
    const osg::ref_ptr<osg::Image> frame = grab();
    if (background_ != PictureOptions::Background::kTransparent) return shrink(*frame, supersample_);
    clearTo(0);
    const osg::ref_ptr<osg::Image> over_black = grab();
    clearTo(1);
    return cutOut(*over_black, *frame, supersample_);
  }
  bool closed() const override { return false; }
  bool takePictureRequest() override { return false; }

 private:
  CameraPose cameraNow() {
    if (const std::optional<CameraPose> place = follow_.choice().place()) return *place;
    const CameraPose pose = follow_.at(picture_.time(), picture_.subject(), aspect_, picture_.usedWidth(), false);
    const double finished = picture_.finishedFor();
    return finished < 0 ? pose : walk_.at(finished, 0, pose, picture_.middleOfGoals());
  }
  osg::Group* root() { return retained_ ? retained_->root() : picture_.root(); }
  osg::ref_ptr<osg::Image> grab() {
    grabber_->arm();
    render();
    return grabber_->take();
  }
  void clearTo(float grey) { viewer_.getCamera()->setClearColor({grey, grey, grey, 1}); }

  Picture& picture_;
  std::optional<RetainedSpace> retained_;  // for more than one picture
  FollowCamera follow_;
  FinishWalk walk_;
  const PictureOptions::Background background_;
  const int supersample_;
  const double aspect_;
  EglContext context_;
  osg::ref_ptr<FrameGrabber> grabber_ = new FrameGrabber;
  osgViewer::Viewer viewer_;
  osg::ref_ptr<osgViewer::GraphicsWindowEmbedded> window_;
};

}  // namespace

std::unique_ptr<Renderer> makeOffscreenRenderer(Picture& picture, const PictureOptions& options, Pictures pictures) {
  return std::make_unique<OffscreenRenderer>(picture, options, pictures);
}

}  // namespace presa::view
