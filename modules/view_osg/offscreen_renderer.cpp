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
constexpr double kLarger = 2;    ///< so many times
constexpr double kFilmLarger = 1.5;

class OffscreenRenderer final : public Renderer {
 public:
  OffscreenRenderer(Picture& picture, const PictureOptions& options, Pictures pictures)
      : picture_(picture),
        retained_(picture, grabber_),
        follow_(options, picture.elevation()),
        background_(options.background),
        aspect_(static_cast<double>(options.width) / options.height) {
    picture.setQuick(pictures != Pictures::kOne);
    // front to back, so that hidden surfaces are not shaded
    osgUtil::RenderBin::setDefaultRenderBinSortMode(osgUtil::RenderBin::SORT_FRONT_TO_BACK);
    window_ = viewer_.setUpViewerAsEmbeddedInWindow(0, 0, options.width, options.height);
    viewer_.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
    viewer_.setKeyEventSetsDone(0);
    viewer_.setLightingMode(osg::View::NO_LIGHT);
    viewer_.setSceneData(retained_.root());
    viewer_.getCamera()->setProjectionMatrixAsPerspective(kFieldOfView, aspect_, 0.01, 10);
    viewer_.getCamera()->setClearMask(0);  // the frame buffer object is the picture
    const double larger = pictures == Pictures::kFilm ? kFilmLarger : kLarger;
    const bool smoothed = std::max(options.width, options.height) <= kSmoothed;
    retained_.setSize(options.width, options.height, smoothed ? larger : 1);
    retained_.clearTo(1);  // seen only without a sky
    picture.hud().setAspect(aspect_);
    viewer_.realize();
  }

  ~OffscreenRenderer() override {
    context_.makeCurrent();
    const unsigned id = window_->getState()->getContextID();
    retained_.root()->releaseGLObjects(window_->getState());
    viewer_.setSceneData(nullptr);
    osg::deleteAllGLObjects(id);
  }

  void render() override {
    const CameraPose pose = cameraNow();
    osg::Camera& camera = *viewer_.getCamera();
    camera.setViewMatrixAsLookAt(toOsg(pose.eye), toOsg(pose.target), toOsg(upOf(pose)));
    picture_.seenFrom(pose);
    retained_.prepare(camera.getViewMatrix() * camera.getProjectionMatrix(), picture_.time(), true);
    viewer_.frame();
  }
  osg::ref_ptr<osg::Image> capture() override {
    const osg::ref_ptr<osg::Image> frame = grab();
    if (background_ != PictureOptions::Background::kTransparent) return frame;
    retained_.clearTo(0);
    const osg::ref_ptr<osg::Image> over_black = grab();
    retained_.clearTo(1);
    return cutOut(*over_black, *frame);
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
  osg::ref_ptr<osg::Image> grab() {
    grabber_->arm();
    render();
    return grabber_->take();
  }

  Picture& picture_;
  osg::ref_ptr<FrameGrabber> grabber_ = new FrameGrabber;
  RetainedSpace retained_;
  FollowCamera follow_;
  FinishWalk walk_;
  const PictureOptions::Background background_;
  const double aspect_;
  EglContext context_{1, 1};  // nothing is drawn into its own buffer
  osgViewer::Viewer viewer_;
  osg::ref_ptr<osgViewer::GraphicsWindowEmbedded> window_;
};

}  // namespace

std::unique_ptr<Renderer> makeOffscreenRenderer(Picture& picture, const PictureOptions& options, Pictures pictures) {
  return std::make_unique<OffscreenRenderer>(picture, options, pictures);
}

}  // namespace presa::view
