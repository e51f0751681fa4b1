#include <gtest/gtest.h>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <osg/Image>
#include <osgDB/ReadFile>

#include "modules/view_osg/view_module.h"
#include "tests/modules/view_osg/pinch_world.h"
#include "tests/modules/view_osg/png_picture.h"

namespace presa::view_test {
namespace {

/// The rubber: red is over 1.5 times green and blue in light or shadow (linear 0.75 : 0.25 : 0.2, sRGB 0.88 : 0.54 :
/// 0.48).
bool isCubeRed(const Color& c) { return c.r > 60 && 2 * c.r > 3 * c.g && 2 * c.r > 3 * c.b; }

struct Blob {
  double x = 0, y = 0;
  int pixels = 0;
};
Blob redBlob(const PngPicture& picture) {
  Blob blob;
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 300; x < 980; ++x)
      if (isCubeRed(picture.at(x, y))) blob.x += x, blob.y += y, ++blob.pixels;
  blob.x /= blob.pixels;
  blob.y /= blob.pixels;
  return blob;
}

class Offscreen : public testing::Test {
 protected:
  // with a display the test would not prove that none is needed
  void SetUp() override { unsetenv("DISPLAY"); }
};

// Off-screen pictures for README and reports must work on a server: a PNG of the stated size with a valid header, with
// the cube in its middle and the head-up display.
TEST_F(Offscreen, PictureHasTheSizeTheCubeAndTheDisplay) {
  const std::string file = tempFile("pinch.png");
  auto run = makePinchRun(RunOptions::View::kOffscreen, file);
  const View::Screenshot made = drawOnce(run, makePinchStates(*run.world, {0, 0, 0.08}));
  ASSERT_EQ(made.outcome, View::Screenshot::Outcome::kWritten) << made.message;

  // PNG: signature, then the IHDR chunk with big-endian width and height
  std::array<unsigned char, 24> head{};
  std::ifstream(file, std::ios::binary).read(reinterpret_cast<char*>(head.data()), head.size());
  const auto number = [&](std::size_t at) {
    return head[at] << 24 | head[at + 1] << 16 | head[at + 2] << 8 | head[at + 3];
  };
  EXPECT_EQ(std::string(head.begin() + 1, head.begin() + 4), "PNG");
  EXPECT_EQ(number(16), 1280);
  EXPECT_EQ(number(20), 720);

  const PngPicture picture(file);
  const Color middle = picture.at(640, 360);
  EXPECT_TRUE(isCubeRed(middle)) << middle.r << ' ' << middle.g << ' ' << middle.b;
  EXPECT_FALSE(isCubeRed(picture.at(640, 20)));

  // text is nearly white, and nothing else at the upper left is
  int ink = 0;
  for (int y = 20; y < 60; ++y)
    for (int x = 18; x < 120; ++x) {
      const Color c = picture.at(x, y);
      ink += c.r > 200 && c.g > 200 && c.b > 200;
    }
  EXPECT_GT(ink, 100);
}

// Poses come from the object state, not from the scene: a cube moved to the right, without fingers, is drawn farther
// right, with the camera fixed.
TEST_F(Offscreen, MovingTheObjectMovesItsPixels) {
  std::array<Blob, 2> blobs;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string file = tempFile("moved_" + std::to_string(i) + ".png");
    auto run = makePinchRun(RunOptions::View::kOffscreen, file);
    // a free anchor of another colour on either side keeps the framing constant
    for (const double x : {-0.15, 0.15}) {
      Body anchor = run.world->scene.bodies[1];
      anchor.material = 0;
      anchor.X_WB.p = {x, 0, kCubeEdge / 2};
      run.world->scene.bodies.push_back(anchor);
    }
    run.world->meshes.resize(4);
    PinchStates states = makePinchStates(*run.world, {i == 0 ? -0.03 : 0.03, 0, kCubeEdge / 2});
    states.device = DeviceState();
    states.contacts = ContactExchange();
    ASSERT_EQ(drawOnce(run, states).outcome, View::Screenshot::Outcome::kWritten);
    blobs[i] = redBlob(PngPicture(file));
    ASSERT_GT(blobs[i].pixels, 500);
  }
  EXPECT_GT(blobs[1].x, blobs[0].x + 40);
}

// Without dynamics (a fixed world, or before the first step) there is no object state: bodies have their start poses.
TEST_F(Offscreen, WithoutObjectStateBodiesStandAtTheirStart) {
  const std::string file = tempFile("start.png");
  auto run = makePinchRun(RunOptions::View::kOffscreen, file);
  view::ViewModule module(run.world, run.options);
  module.start();
  module.step({0, 0, 1.0 / 60});
  module.stop();
  ASSERT_EQ(module.screenshot().outcome, View::Screenshot::Outcome::kWritten);
  EXPECT_TRUE(isCubeRed(PngPicture(file).at(640, 360)));
}

// The picture shows the requested moment: it is taken at the first tick not before that time, and later ticks do not
// change it.
TEST_F(Offscreen, PictureIsTakenAtItsTime) {
  const std::string file = tempFile("timed.png");
  auto run = makePinchRun(RunOptions::View::kOffscreen, file);
  run.options.screenshot_time = 0.1;
  view::ViewModule module(run.world, run.options);
  Feed feed(module);
  module.start();
  const PinchStates states = makePinchStates(*run.world, {0, 0, 0.08});
  for (std::uint64_t i = 0; i < 12; ++i) {
    const double time = static_cast<double>(i) / 60;
    feed.publish(states, time);
    module.step({i, time, 1.0 / 60});
    EXPECT_EQ(std::filesystem::exists(file), time >= 0.1) << time;
  }
  module.stop();
  EXPECT_NE(module.screenshot().message.find("t = 0.100 s"), std::string::npos) << module.screenshot().message;
}

// An unwritable path is a user error that is found late: the run must report the reason and not crash.
TEST_F(Offscreen, UnwritablePathIsReported) {
  auto run = makePinchRun(RunOptions::View::kOffscreen, "/nowhere/at/all/picture.png");
  const View::Screenshot made = drawOnce(run, makePinchStates(*run.world, {0, 0, 0.08}));
  EXPECT_EQ(made.outcome, View::Screenshot::Outcome::kFailed);
  EXPECT_NE(made.message.find("/nowhere/at/all/picture.png"), std::string::npos);
}

// A window without a display is refused before the run starts, with a suggestion.
TEST_F(Offscreen, WindowWithoutDisplayIsAnInputError) {
  const PinchRun run = makePinchRun(RunOptions::View::kWindow, "");
  view::ViewModule module(run.world, run.options);
  try {
    module.start();
    FAIL() << "opened a window without a display";
  } catch (const InputError& error) {
    EXPECT_NE(error.diagnostics().text().find("DISPLAY"), std::string::npos) << error.diagnostics().text();
  }
}

/// Number of wire pixels: much more `strong` than `weak`.
template <class Strong, class Weak>
int wires(const PngPicture& picture, Strong strong, Weak weak) {
  int pixels = 0;
  for (int y = 70; y < 650; ++y)
    for (int x = 300; x < 980; ++x)
      pixels += picture.at(x, y).*strong > 150 && 2 * picture.at(x, y).*weak < picture.at(x, y).*strong;
  return pixels;
}

// --show adds lines of the haptic (blue) and the physics (magenta) geometry and can hide the bodies; by default there
// are no lines.
TEST_F(Offscreen, ShowsWhatIsAskedFor) {
  const auto draw = [](std::vector<std::string> show) {
    const std::string file = tempFile("show.png");
    auto run = makePinchRun(RunOptions::View::kOffscreen, file);
    run.options.show = std::move(show);
    PinchStates states = makePinchStates(*run.world, {0, 0, 0.08});
    states.device = DeviceState();
    states.contacts = ContactExchange();
    EXPECT_EQ(drawOnce(run, states).outcome, View::Screenshot::Outcome::kWritten);
    return PngPicture(file);
  };
  const auto blue = [](const PngPicture& p) { return wires(p, &Color::b, &Color::r); };
  const PngPicture plain = draw({}), haptic = draw({"haptic"}), physics = draw({"physics", "no-visual"});
  EXPECT_EQ(blue(plain), 0);
  EXPECT_GT(blue(haptic), 300);
  EXPECT_GT(redBlob(plain).pixels, 5000);
  EXPECT_GT(wires(physics, &Color::b, &Color::g), 300);
  EXPECT_LT(redBlob(physics).pixels, 1000);
  auto run = makePinchRun(RunOptions::View::kOffscreen, "");
  run.options.show = {"hiptic"};
  EXPECT_THROW(view::ViewModule module(run.world, run.options), InputError);
}

// During the last of five seconds thumb and index press with a constant force each, the thumb with 3.2 N. The axis ends at
// 5 N, 46 lines above its zero, which is 316 above the lower edge: the thumb's line is 345.4 above it, for the last fifth
// of the width (66 to 268); the rest is empty.
TEST_F(Offscreen, PlotsTheLastSeconds) {
  const std::string file = tempFile("plots.png");
  auto run = makePinchRun(RunOptions::View::kOffscreen, file);
  run.options.show = {"plots"};
  {
    view::ViewModule module(run.world, run.options);
    Feed feed(module);
    module.start();
    for (std::uint64_t i = 0; i <= 60; ++i) {
      feed.publish(makePinchStates(*run.world, {0, 0, 0.08}), static_cast<double>(i) / 60);
      module.step({i, static_cast<double>(i) / 60, 1.0 / 60});
    }
    module.stop();
  }
  const PngPicture picture(file);
  const auto line = [&](int x) {  // within two lines of the expected height: it is one line thick, and averaged
    int max = 0;
    for (int y = 372; y <= 377; ++y) max = std::max(max, picture.at(x, y).b - picture.at(x, y).r);
    return max;
  };
  for (const int x : {235, 250, 264}) EXPECT_GT(line(x), 60) << x;
  for (const int x : {90, 140, 210}) EXPECT_LT(line(x), 30) << x;
}

}  // namespace
}  // namespace presa::view_test
