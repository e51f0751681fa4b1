#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <osg/GraphicsContext>
#include <osgViewer/GraphicsWindow>
#include <sstream>

#include "modules/view_osg/view_module.h"
#include "tests/view/pinch_world.h"

namespace presa::view_test {
namespace {

// Opens a real window on the display it finds: run by the test below under its own X server.
TEST(OnDisplay, DISABLED_DrawsFiveFrames) {
  const std::string file = testing::TempDir() + "presa_window_" + std::to_string(getpid()) + ".png";
  const auto world = makePinchWorld(RunOptions::View::kWindow, file);
  view::ViewModule module(world);
  Feed feed(module);
  module.start();
  for (std::uint64_t i = 0; i < 5; ++i) {
    const double time = static_cast<double>(i) / 60;
    feed.publish(makePinchStates(*world, {0, 0, 0.08}), time);
    module.step({i, time, 1.0 / 60});
    EXPECT_FALSE(module.wantsStop());
  }
  module.stop();
  EXPECT_EQ(module.screenshot().outcome, View::Screenshot::Outcome::kWritten) << module.screenshot().message;
  EXPECT_GT(std::filesystem::file_size(file), 20000U);  // a uniform 1280 x 720 picture packs to a few kilobytes
  std::filesystem::remove(file);
}

/// A window that is driven through OSG's event queue, as its X events are. The scene stands still.
class Driven {
 public:
  Driven() : module_(world_), feed_(module_) {
    std::filesystem::current_path(testing::TempDir());  // pictures that a key asks for go there
    module_.start();
    frame();
    for (osg::GraphicsContext* context : osg::GraphicsContext::getAllRegisteredGraphicsContexts()) {
      if (auto* window = dynamic_cast<osgViewer::GraphicsWindow*>(context); window && window->valid()) window_ = window;
    }
    std::filesystem::remove(picture());
  }
  ~Driven() {
    module_.stop();
    std::filesystem::remove(picture());
  }

  void frame() {
    feed_.publish(states_, 0);
    module_.step({0, 0, 1.0 / 60});
  }
  void press(int key) {
    events().keyPress(key);
    events().keyRelease(key);
    frame();
  }
  void drag(float from_x, float to_x, float y) {
    events().mouseButtonPress(from_x, y, 1);
    frame();
    for (int i = 1; i <= 5; ++i) {
      events().mouseMotion(from_x + static_cast<float>(i) / 5 * (to_x - from_x), y);
      frame();
    }
    events().mouseButtonRelease(to_x, y, 1);
    frame();
  }
  void scroll() {
    events().mouseScroll(osgGA::GUIEventAdapter::SCROLL_UP);
    frame();
  }

  /// Where the camera is and what it looks at, some way off [m].
  std::pair<osg::Vec3d, osg::Vec3d> look() const {
    osg::Vec3d eye, center, up;
    (*window_->getCameras().begin())->getViewMatrixAsLookAt(eye, center, up);
    return {eye, center - eye};
  }
  /// Bytes of the picture that the key 's' saves; the file is gone afterwards.
  std::string pictureByKey() {
    press('s');
    std::ostringstream bytes;
    bytes << std::ifstream(picture(), std::ios::binary).rdbuf();
    std::filesystem::remove(picture());
    return bytes.str();
  }
  bool wantsStop() const { return module_.wantsStop(); }
  bool found() const { return window_ != nullptr && !window_->getCameras().empty(); }

 private:
  osgGA::EventQueue& events() { return *window_->getEventQueue(); }
  std::string picture() const { return "presa-" + world_->scene.name + "-0.000s.png"; }

  std::shared_ptr<const World> world_ = makePinchWorld(RunOptions::View::kWindow, "");
  view::ViewModule module_;
  Feed feed_;
  PinchStates states_ = makePinchStates(*world_, {0, 0, 0.08});
  osgViewer::GraphicsWindow* window_ = nullptr;
};

// What the help of the window promises, key by key and with the mouse.
TEST(OnDisplay, DISABLED_AnswersKeysAndMouse) {
  Driven view;
  ASSERT_TRUE(view.found());
  const auto framed = view.look();
  view.press(' ');  // reserved: must not jump to the manipulator's home
  EXPECT_LT((view.look().first - framed.first).length(), 1e-9);

  const std::string plain = view.pictureByKey();
  EXPECT_GT(plain.size(), 20000U);
  const std::string told = view.pictureByKey();  // now with the line that says what was saved
  view.press('?');
  EXPECT_NE(view.pictureByKey(), told);
  view.press('?');
  EXPECT_EQ(view.pictureByKey(), told);

  view.drag(640, 840, 360);
  const auto turned = view.look();
  EXPECT_GT((turned.first - framed.first).length(), 0.1 * framed.first.length());
  view.scroll();
  EXPECT_GT((view.look().first - turned.first).length(), 1e-3);
  view.press('h');  // back to where everything is in the picture
  view.frame();
  EXPECT_LT((view.look().first - framed.first).length(), 1e-6);

  EXPECT_FALSE(view.wantsStop());
  view.press(osgGA::GUIEventAdapter::KEY_Escape);
  view.frame();
  EXPECT_TRUE(view.wantsStop());
}

/// Status of one of the tests above under an X server of its own; what it said is in `log`.
int onDisplay(const std::string& test, const std::string& log) {
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  return std::system(("xvfb-run -a -s '-screen 0 1400x900x24' '" + program + "' --gtest_filter=OnDisplay.DISABLED_" +
                      test + " --gtest_also_run_disabled_tests > '" + log + "' 2>&1")
                         .c_str());
}

// The window must work on any X server, also one with a software renderer: opens, draws five frames, saves, closes.
TEST(Window, OpensDrawsAndClosesUnderXvfb) {
  const std::string log = testing::TempDir() + "presa_window.log";
  EXPECT_EQ(onDisplay("DrawsFiveFrames", log), 0) << "see " << log;
}

TEST(Window, AnswersKeysAndMouseUnderXvfb) {
  const std::string log = testing::TempDir() + "presa_keys.log";
  EXPECT_EQ(onDisplay("AnswersKeysAndMouse", log), 0) << "see " << log;
}

}  // namespace
}  // namespace presa::view_test
