#include "framework/session/participant_page.h"

#include <cstdlib>
#include <osg/BlendFunc>
#include <osg/Camera>
#include <osg/Notify>
#include <osgViewer/Viewer>
#include <stdexcept>

#include "framework/core/diagnostics/refuse.h"
#include "modules/view_osg/participant_panel.h"
#include "modules/view_osg/typed_keys.h"
#include "modules/view_osg/window_context.h"

namespace presa::view {
namespace {

constexpr float kLines = 720;  // height of the panel's coordinates

class OsgParticipantPage final : public ParticipantPage {
 public:
  OsgParticipantPage() : window_(keptWindow("Presa", 1280, 720).context) {
    const osg::GraphicsContext::Traits& size = *window_->getTraits();
    typed_ = new TypedKeys(size.width, size.height);
    viewer_.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
    viewer_.setLightingMode(osg::View::NO_LIGHT);
    viewer_.setKeyEventSetsDone(0);
    osg::Camera* camera = viewer_.getCamera();
    camera->setGraphicsContext(window_);
    camera->setViewport(0, 0, size.width, size.height);
    camera->setProjectionResizePolicy(osg::Camera::FIXED);
    camera->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
    camera->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    camera->setClearColor({0, 0, 0, 1});
    osg::StateSet* state = root_->getOrCreateStateSet();
    state->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    state->setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
    state->setAttributeAndModes(new osg::BlendFunc(osg::BlendFunc::SRC_ALPHA, osg::BlendFunc::ONE_MINUS_SRC_ALPHA));
    state->setRenderBinDetails(0, "TraversalOrderBin", osg::StateSet::OVERRIDE_RENDERBIN_DETAILS);
    viewer_.setSceneData(root_);
    viewer_.addEventHandler(typed_);
    viewer_.realize();
    if (!viewer_.isRealized()) throw std::runtime_error("the window opened, but it gives no OpenGL context");
  }

  /// The window stays, with what it shows: a run draws into it next.
  ~OsgParticipantPage() override {
    if (closed()) return;
    if (window_->makeCurrent()) {
      root_->releaseGLObjects(window_->getState());
      window_->releaseContext();
    }
    viewer_.setSceneData(nullptr);
    viewer_.getCamera()->setGraphicsContext(nullptr);  // else the viewer closes it
  }

  void show(const ParticipantScreen& screen) override {
    panel_.show({.bodies = false, .fingertips = false, .fixation = screen.fixation, .text = screen.text});
    frame();
    typed_->drop();
  }

  char key() override {
    if (closed()) return 0;
    frame();  // also after another window has covered it
    return typed_->next();
  }

  bool closed() const override { return viewer_.done() || !window_->isRealized(); }

 private:
  void frame() {
    if (closed()) return;
    viewer_.advance();
    viewer_.eventTraversal();
    const double width = kLines * typed_->width / typed_->height;
    viewer_.getCamera()->setViewport(0, 0, typed_->width, typed_->height);
    viewer_.getCamera()->setProjectionMatrixAsOrtho(-width / 2, width / 2, -kLines / 2, kLines / 2, -1, 1);
    viewer_.renderingTraversals();
  }

  osg::ref_ptr<osg::GraphicsContext> window_;
  osg::ref_ptr<osg::Group> root_ = new osg::Group;
  osg::ref_ptr<TypedKeys> typed_;
  ParticipantPanel panel_{*root_};
  osgViewer::Viewer viewer_;
};

}  // namespace
}  // namespace presa::view

extern "C" __attribute__((visibility("default"))) presa::ParticipantPage* presaOpenParticipantPage() {
  setenv("LP_NUM_THREADS", "1", 0);  // Mesa's software renderer would use all cores
  osg::setNotifyLevel(osg::FATAL);
  try {
    return new presa::view::OsgParticipantPage;
  } catch (const std::exception& error) {
    presa::refuse(703, "", std::string("cannot open the participant's window: ") + error.what(),
                  "set DISPLAY to a running X server, or leave out --window");
  }
}
