#include "framework/session/text_window.h"

#include <algorithm>
#include <cstdlib>
#include <osg/Camera>
#include <osg/Notify>
#include <osgViewer/Viewer>
#include <stdexcept>
#include <thread>

#include "framework/core/diagnostics/refuse.h"
#include "framework/core/schedule/clock.h"
#include "modules/view_osg/hud_widgets.h"
#include "modules/view_osg/typed_keys.h"
#include "modules/view_osg/window_context.h"

namespace presa::view {
namespace {

constexpr int kWindowWidth = 1100, kWindowHeight = 560;
constexpr float kTypedSize = 18, kTypedLine = 26, kTextMargin = 18;  // [pixels]
constexpr float kAdvance = 0.602F;  // character width of DejaVu Sans Mono, relative to its size

class OsgTextWindow final : public TextWindow {
 public:
  explicit OsgTextWindow(const std::string& title) : window_(openWindow(title, kWindowWidth, kWindowHeight).context) {
    viewer_.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
    viewer_.setLightingMode(osg::View::NO_LIGHT);
    viewer_.setKeyEventSetsDone(0);  // Esc is an ordinary key
    osg::Camera* camera = viewer_.getCamera();
    camera->setGraphicsContext(window_);
    camera->setViewport(0, 0, kWindowWidth, kWindowHeight);
    camera->setProjectionResizePolicy(osg::Camera::FIXED);
    camera->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
    camera->setClearColor({0.07F, 0.08F, 0.10F, 1});
    page_->getOrCreateStateSet()->setMode(GL_BLEND, osg::StateAttribute::ON);
    page_->getOrCreateStateSet()->setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
    viewer_.setSceneData(page_);
    viewer_.addEventHandler(typed_);
    viewer_.realize();
    if (!viewer_.isRealized()) throw std::runtime_error("the window opened, but it gives no OpenGL context");
  }
  ~OsgTextWindow() override {
    viewer_.setSceneData(nullptr);
    if (window_->valid()) window_->close();
  }

  std::size_t columns() const override { return cells(static_cast<float>(typed_->width), kTypedSize * kAdvance); }
  std::size_t rows() const override { return cells(static_cast<float>(typed_->height), kTypedLine); }
  bool closed() const override { return viewer_.done() || !window_->isRealized(); }

  void show(const std::vector<Line>& lines) override {
    while (labels_.size() < lines.size()) {
      const float y = -static_cast<float>(labels_.size() + 1) * kTypedLine;  // below the top edge
      labels_.emplace_back(*page_, kTextMargin, y, kTypedSize, osg::Vec4(1, 1, 1, 1), Typeface::kMono);
    }
    for (std::size_t i = 0; i < labels_.size(); ++i) {
      labels_[i].set(i < lines.size() ? lines[i].text : "");
      if (i >= lines.size()) continue;
      const auto& [red, green, blue] = lines[i].color;
      labels_[i].setColor({red, green, blue, 1});
    }
    frame();
  }

  char key(int ms) override {
    const std::int64_t until = monotonicNs() + std::int64_t{ms} * 1'000'000;
    for (;;) {
      if (closed()) return 0;
      viewer_.advance();
      viewer_.eventTraversal();
      if (const char pressed = typed_->next(); pressed != 0) return pressed;
      const std::int64_t now = monotonicNs();
      if (now >= until) return 0;
      sleepUntilNs(std::min(until, now + 20'000'000));
    }
  }

 private:
  static std::size_t cells(float pixels, float cell) {
    return static_cast<std::size_t>(std::max(1.0F, (pixels - 2 * kTextMargin) / cell));
  }
  void frame() {
    if (closed()) return;
    // one unit per pixel, origin at the top left corner
    viewer_.getCamera()->setViewport(0, 0, typed_->width, typed_->height);
    viewer_.getCamera()->setProjectionMatrixAsOrtho2D(0, typed_->width, -typed_->height, 0);
    viewer_.frame();
  }

  osg::ref_ptr<osg::GraphicsContext> window_;
  osg::ref_ptr<osg::Group> page_ = new osg::Group;
  osg::ref_ptr<TypedKeys> typed_ = new TypedKeys(kWindowWidth, kWindowHeight);
  std::vector<Label> labels_;
  osgViewer::Viewer viewer_;
};

}  // namespace
}  // namespace presa::view

extern "C" __attribute__((visibility("default"))) presa::TextWindow* presaOpenTextWindow(const char* title) {
  // Mesa's software renderer would use all cores
  setenv("LP_NUM_THREADS", "1", 0);
  osg::setNotifyLevel(osg::FATAL);
  try {
    return new presa::view::OsgTextWindow(title);
  } catch (const std::exception& error) {
    presa::refuse(703, "", std::string("cannot open a window: ") + error.what(),
                  "set DISPLAY to a running X server, or use the terminal: --operator terminal");
  }
}
