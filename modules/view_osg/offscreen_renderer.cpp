#include <osg/GLObjects>
#include <osgViewer/Viewer>

#include "modules/view_osg/follow_camera.h"
#include "modules/view_osg/frame_image.h"
#include "modules/view_osg/gl_context_egl.h"
#include "modules/view_osg/osg_convert.h"
#include "modules/view_osg/renderer.h"

namespace presa::view {
namespace {

constexpr int kWidth = 1280, kHeight = 720, kSupersample = 2;

class OffscreenRenderer final : public Renderer {
 public:
  explicit OffscreenRenderer(Picture& picture)
      : picture_(picture), context_(kSupersample * kWidth, kSupersample * kHeight) {
    window_ = viewer_.setUpViewerAsEmbeddedInWindow(0, 0, kSupersample * kWidth, kSupersample * kHeight);
    viewer_.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
    viewer_.setKeyEventSetsDone(0);
    viewer_.setLightingMode(osg::View::NO_LIGHT);
    viewer_.setSceneData(picture.root());
    osg::Camera* camera = viewer_.getCamera();
    camera->setFinalDrawCallback(grabber_);
    camera->setProjectionMatrixAsPerspective(kFieldOfView, static_cast<double>(kWidth) / kHeight, 0.01, 10);
    picture.setSize(kSupersample * kWidth, kSupersample * kHeight);
    picture.hud().setAspect(static_cast<double>(kWidth) / kHeight);
    viewer_.realize();
  }

  ~OffscreenRenderer() override {
    context_.makeCurrent();
    const unsigned id = window_->getState()->getContextID();
    picture_.root()->releaseGLObjects(window_->getState());
    viewer_.setSceneData(nullptr);
    osg::deleteAllGLObjects(id);
  }

  void render() override {
    const CameraPose pose = follow_.at(picture_.time(), picture_.subject(), static_cast<double>(kWidth) / kHeight,
                                       picture_.usedWidth(), false);
    viewer_.getCamera()->setViewMatrixAsLookAt(toOsg(pose.eye), toOsg(pose.target), {0, 0, 1});
    viewer_.frame();
  }
  osg::ref_ptr<osg::Image> capture() override {
    grabber_->arm();
    render();
    return shrink(*grabber_->take(), kSupersample);
  }
  bool closed() const override { return false; }
  bool takePictureRequest() override { return false; }

 private:
  Picture& picture_;
  FollowCamera follow_;  // in films
  EglContext context_;
  osg::ref_ptr<FrameGrabber> grabber_ = new FrameGrabber;
  osgViewer::Viewer viewer_;
  osg::ref_ptr<osgViewer::GraphicsWindowEmbedded> window_;
};

}  // namespace

std::unique_ptr<Renderer> makeOffscreenRenderer(Picture& picture) {
  return std::make_unique<OffscreenRenderer>(picture);
}

}  // namespace presa::view
