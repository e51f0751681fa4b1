#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

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

// The window must work on any X server, also one with a software renderer: opens, draws five frames, saves, closes.
TEST(Window, OpensDrawsAndClosesUnderXvfb) {
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  const std::string command =
      "xvfb-run -a -s '-screen 0 1400x900x24' '" + program +
      "' --gtest_filter=OnDisplay.DISABLED_DrawsFiveFrames --gtest_also_run_disabled_tests > '" + testing::TempDir() +
      "presa_window.log' 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0) << "see " << testing::TempDir() << "presa_window.log";
}

}  // namespace
}  // namespace presa::view_test
