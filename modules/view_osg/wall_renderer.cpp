#include <osg/ColorMask>
#include <osg/GLObjects>
#include <osgUtil/RenderBin>
#include <osgViewer/GraphicsWindow>
#include <osgViewer/Renderer>
#include <osgViewer/Viewer>
#include <stdexcept>

#include "modules/view_osg/frame_image.h"
#include "modules/view_osg/gl_context_egl.h"
#include "modules/view_osg/osg_convert.h"
#include "modules/view_osg/renderer.h"
#include "modules/view_osg/window_context.h"

namespace presa::view {
namespace {

using walls::Stereo;

constexpr int kSupersample = 2;               ///< of a saved picture, off-screen
constexpr double kNear = 0.001, kFar = 1000;  ///< before OSG fits them to what is drawn [m]

/// A part of the canvas for one eye.
struct Pass {
  const walls::Frustum& eye;
  double left = 0, bottom = 0, width = 1, height = 1;  ///< shares of the canvas
  bool red = true, cyan = true;                        ///< channels that it writes
  GLenum buffer = GL_BACK;
};

std::vector<Pass> passesOf(const walls::Canvas& canvas) {
  const auto& [left, right] = canvas.eyes;
  switch (canvas.quad_refused ? Stereo::kMono : canvas.stereo) {
    case Stereo::kMono:
      return {{left}};
    case Stereo::kSideBySide:
      return {{left, 0, 0, 0.5, 1}, {right, 0.5, 0, 0.5, 1}};
    case Stereo::kTopBottom:
      return {{left, 0, 0.5, 1, 0.5}, {right, 0, 0, 1, 0.5}};
    case Stereo::kAnaglyph:
      return {{.eye = left, .cyan = false}, {.eye = right, .red = false}};
    case Stereo::kQuad:
      return {{.eye = left, .buffer = GL_BACK_LEFT}, {.eye = right, .buffer = GL_BACK_RIGHT}};
  }
  return {};
}

bool drawsInSoftware() {
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return name != nullptr && std::string_view(name).find("pipe") != std::string_view::npos;
}

/// Draws each eye with its own frustum into its part of one surface, then shows all of it at once.
class WallRenderer final : public Renderer {
 public:
  WallRenderer(Picture& picture, walls::Canvas& canvas, bool window, const std::string& title) : canvas_(canvas) {
    if (window)
      openWindowOf(title);
    else
      egl_.emplace(kSupersample * canvas.width, kSupersample * canvas.height);
    if (!window && canvas.stereo == Stereo::kQuad) canvas.quad_refused = true;
    picture.setQuick(drawsInSoftware());
    picture.surround(*root_);
    osgUtil::RenderBin::setDefaultRenderBinSortMode(osgUtil::RenderBin::SORT_FRONT_TO_BACK);
    const int scale = window ? 1 : kSupersample;
    surface_ = viewer_.setUpViewerAsEmbeddedInWindow(0, 0, scale * canvas.width, scale * canvas.height);
    viewer_.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
    viewer_.setKeyEventSetsDone(0);
    viewer_.setLightingMode(osg::View::NO_LIGHT);
    viewer_.setSceneData(root_);
    viewer_.getCamera()->setFinalDrawCallback(grabber_);
    viewer_.getCamera()->setClearColor({1, 1, 1, 1});  // seen only without a sky
    viewer_.realize();
  }

  ~WallRenderer() override {
    makeCurrent();
    const unsigned id = surface_->getState()->getContextID();
    root_->releaseGLObjects(surface_->getState());
    viewer_.setSceneData(nullptr);
    osg::deleteAllGLObjects(id);
    if (window_ && window_->valid()) window_->close();
  }

  void render() override {
    heedInput();
    if (closed()) return;
    makeCurrent();
    if (!std::exchange(warm_, true)) warmUp();
    draw(1);
    if (window_) window_->swapBuffers();
  }

  osg::ref_ptr<osg::Image> capture() override {
    if (closed()) return nullptr;
    makeCurrent();
    grab_ = true;
    draw(window_ ? 1 : kSupersample);
    const osg::ref_ptr<osg::Image> image = grabber_->take();
    return image && !window_ ? shrink(*image, kSupersample) : image;
  }

  bool closed() const override { return closed_; }
  bool takePictureRequest() override { return false; }

 private:
  void openWindowOf(const std::string& title) {
    const bool quad = canvas_.stereo == Stereo::kQuad;
    WindowContext window = wallWindow(title, canvas_.width, canvas_.height, quad);
    if (!window.context) window = wallWindow(title, canvas_.width, canvas_.height, false);
    window_ = window.context;
    if (!window_->realize() || !window_->makeCurrent())
      throw std::runtime_error("the window opened, but it gives no OpenGL context");
    if (auto* shown = dynamic_cast<osgViewer::GraphicsWindow*>(window_.get())) shown->useCursor(false);
    GLboolean both = GL_FALSE;
    glGetBooleanv(GL_STEREO, &both);
    canvas_.quad_refused = quad && both == GL_FALSE;
  }
  void makeCurrent() {
    if (window_)
      window_->makeCurrent();
    else
      egl_->makeCurrent();
  }
  /// Draws everything once, hidden parts and those beside the picture, too: a driver compiles each shader when it is
  /// first used, which would halt all walls in the middle of a run.
  void warmUp() {
    osg::Camera& camera = *viewer_.getCamera();
    auto& scene_view = *static_cast<osgViewer::Renderer*>(camera.getRenderer())->getSceneView(0);
    const osg::CullSettings::CullingMode culling = camera.getCullingMode();
    camera.setCullingMode(osg::CullSettings::NO_CULLING);
    scene_view.getCullVisitor()->setNodeMaskOverride(~0U);
    draw(1);
    scene_view.getCullVisitor()->setNodeMaskOverride(0);
    camera.setCullingMode(culling);
  }
  void draw(int scale) {
    const std::vector<Pass> passes = passesOf(canvas_);
    for (std::size_t i = 0; i < passes.size(); ++i) {
      if (grab_ && i + 1 == passes.size()) grabber_->arm(), grab_ = false;
      drawPass(passes[i], scale);
    }
  }
  void drawPass(const Pass& pass, int scale) {
    osg::Camera& camera = *viewer_.getCamera();
    const double width = scale * canvas_.width, height = scale * canvas_.height;
    camera.setViewport(
        new osg::Viewport(pass.left * width, pass.bottom * height, pass.width * width, pass.height * height));
    // objects of their own: OpenSceneGraph applies no state twice that it has seen, changed or not
    root_->getOrCreateStateSet()->setAttribute(pass.red && pass.cyan ? all_ : pass.red ? red_ : cyan_);
    camera.setClearMask(pass.red ? GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT : GL_DEPTH_BUFFER_BIT);
    if (window_) camera.setDrawBuffer(pass.buffer);
    const walls::Frustum& eye = pass.eye;
    camera.setViewMatrix(toOsg(eye.X_WE.inverse()));
    camera.setProjectionMatrixAsFrustum(kNear * eye.left, kNear * eye.right, kNear * eye.bottom, kNear * eye.top, kNear,
                                        kFar);
    viewer_.frame();
  }
  void heedInput() {
    auto* window = dynamic_cast<osgViewer::GraphicsWindow*>(window_.get());
    if (window == nullptr) return;
    window->checkEvents();
    osgGA::EventQueue::Events events;
    window->getEventQueue()->takeEvents(events);
    for (const auto& event : events) {
      const osgGA::GUIEventAdapter* input = event->asGUIEventAdapter();
      if (input == nullptr) continue;
      const int type = input->getEventType();
      closed_ = closed_ || type == osgGA::GUIEventAdapter::CLOSE_WINDOW ||
                type == osgGA::GUIEventAdapter::QUIT_APPLICATION ||
                (type == osgGA::GUIEventAdapter::KEYDOWN && input->getKey() == osgGA::GUIEventAdapter::KEY_Escape);
    }
    closed_ = closed_ || !window_->isRealized();
  }

  walls::Canvas& canvas_;
  std::optional<EglContext> egl_;              // off-screen
  osg::ref_ptr<osg::GraphicsContext> window_;  // in a window
  osg::ref_ptr<osg::Group> root_ = new osg::Group;
  osg::ref_ptr<osg::ColorMask> all_ = new osg::ColorMask, red_ = new osg::ColorMask(true, false, false, true),
                               cyan_ = new osg::ColorMask(false, true, true, true);
  osg::ref_ptr<FrameGrabber> grabber_ = new FrameGrabber;
  osgViewer::Viewer viewer_;
  osg::ref_ptr<osgViewer::GraphicsWindowEmbedded> surface_;
  bool grab_ = false, closed_ = false, warm_ = false;
};

}  // namespace

std::unique_ptr<Renderer> makeWallRenderer(Picture& picture, walls::Canvas& canvas, bool window,
                                           const std::string& title) {
  return std::make_unique<WallRenderer>(picture, canvas, window, title);
}

}  // namespace presa::view
