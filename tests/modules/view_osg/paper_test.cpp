// Pictures for papers: camera, size, figures, legend, background, offsets.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <osgDB/ReadFile>

#include "modules/view_osg/offset_panel.h"
#include "modules/view_osg/scale_bar.h"
#include "tests/modules/view_osg/pinch_world.h"
#include "tests/modules/view_osg/png_picture.h"

namespace presa::view_test {
namespace {

using Hud = PictureOptions::Hud;
using Background = PictureOptions::Background;

class Paper : public testing::Test {
 protected:
  void SetUp() override { unsetenv("DISPLAY"); }

  /// The pinch, or the scene alone without fingers.
  PngPicture draw(const PictureOptions& picture, bool fingers = true, const std::vector<std::string>& show = {}) {
    file_ = tempFile("paper.png");
    auto run = makePinchRun(RunOptions::View::kOffscreen, file_);
    run.options.picture = picture;
    run.options.show = show;
    PinchStates states = makePinchStates(*run.world, {0, 0, 0.08});
    if (!fingers) states.device = DeviceState(), states.contacts = ContactExchange();
    EXPECT_EQ(drawOnce(run, states).outcome, View::Screenshot::Outcome::kWritten);
    return PngPicture(file_);
  }
  std::string file_;
};

int lightPixels(const PngPicture& picture, int left, int top, int right, int bottom) {
  int count = 0;
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x) {
      const Color c = picture.at(x, y);
      count += c.r > 200 && c.g > 200 && c.b > 200;
    }
  return count;
}

/// Middle of the bounding box of a small green ball.
struct Middle {
  double x, y;
};
Middle greenMiddle(const PngPicture& picture) {
  int left = 1 << 20, right = -1, top = 1 << 20, bottom = -1;
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      const Color c = picture.at(x, y);
      if (!(c.g > 60 && 2 * c.g > 3 * c.r && 2 * c.g > 3 * c.b)) continue;
      left = std::min(left, x), right = std::max(right, x);
      top = std::min(top, y), bottom = std::max(bottom, y);
    }
  return {(left + right + 1) / 2.0, (top + bottom + 1) / 2.0};
}

/// Picture of a green ball of 4 mm radius at `p_W` above the table.
PngPicture drawBall(const Vec3& p_W, const PictureOptions& picture) {
  const std::string file = tempFile("ball.png");
  auto run = makePinchRun(RunOptions::View::kOffscreen, file);
  run.options.picture = picture;
  run.world->scene.materials[1].color = {0.05, 0.9, 0.05};
  run.world->scene.bodies[1].haptic = run.world->scene.bodies[1].physics = Geometry{Sphere{0.004}, Pose{}, {}};
  PinchStates states = makePinchStates(*run.world, p_W);
  states.device = DeviceState(), states.contacts = ContactExchange();
  EXPECT_EQ(drawOnce(run, states).outcome, View::Screenshot::Outcome::kWritten);
  return PngPicture(file);
}

/// Where a pinhole camera with the vertical field of view of the view, +z upwards, shows a point [pixel].
Middle project(const Vec3& p, const CameraPlace& camera, int width, int height) {
  const Vec3 forward = (camera.target - camera.eye).normalized();
  const Vec3 right = forward.cross(Vec3::UnitZ()).normalized(), up = right.cross(forward);
  const Vec3 d = p - camera.eye;
  const double pixels = height / 2.0 / std::tan(view::kFieldOfView / 2 * std::numbers::pi / 180) / d.dot(forward);
  return {width / 2.0 + pixels * d.dot(right), height / 2.0 - pixels * d.dot(up)};
}

// Off the middle, from two sides, in two sizes: within 2 pixels of a pinhole camera's formula. (The sphere's outline is an
// ellipse whose middle is off by less than one pixel here.)
TEST_F(Paper, CameraShowsAPointWhereOpticsSay) {
  const Vec3 p(0.05, -0.02, 0.06);
  const CameraPlace front{{0.1, -0.7, 0.3}, {0, 0, 0.05}}, back{{-0.1, 0.7, 0.3}, {0, 0, 0.05}},
      side{{0.6, 0.2, 0.2}, {0.03, 0.01, 0.02}};
  for (const auto& [width, height, camera] :
       {std::tuple{1280, 720, front}, {1280, 720, back}, {640, 360, side}, {500, 800, back}}) {
    const PngPicture picture = drawBall(p, {.camera = camera, .width = width, .height = height, .hud = Hud::kOff});
    EXPECT_EQ(picture.width(), width);
    EXPECT_EQ(picture.height(), height);
    const Middle seen = greenMiddle(picture), expected = project(p, camera, width, height);
    EXPECT_NEAR(seen.x, expected.x, 2) << width << ", eye " << camera.eye.transpose();
    EXPECT_NEAR(seen.y, expected.y, 2) << width << ", eye " << camera.eye.transpose();
  }
}

// From opposite sides right is left; from above +y is upwards and +x to the right.
TEST_F(Paper, NamedSidesLookFromThere) {
  const auto seen = [&](ViewSide side, const Vec3& offset) {
    const std::string file = tempFile("side.png");
    auto run = makePinchRun(RunOptions::View::kOffscreen, file);
    run.options.picture = {.camera = side, .hud = Hud::kOff};
    run.world->scene.materials.push_back(run.world->scene.materials[1]);
    run.world->scene.materials.back().color = {0.05, 0.9, 0.05};
    Body ball = run.world->scene.bodies[1];
    ball.haptic = ball.physics = Geometry{Sphere{0.004}, Pose{}, {}};
    ball.material = 2;
    ball.X_WB.p = Vec3(0, 0, 0.1) + offset;
    run.world->scene.bodies.push_back(ball);
    run.world->meshes.resize(3);
    view::ViewModule module(run.world, run.options);  // without states, bodies stand at their start
    module.start();
    module.step({0, 0, 1.0 / 60});
    module.stop();
    return greenMiddle(PngPicture(file));
  };
  const Vec3 x(0.06, 0, 0), y(0, 0.06, 0);
  EXPECT_GT(seen(ViewSide::kFront, x).x, 700);
  EXPECT_LT(seen(ViewSide::kBack, x).x, 580);
  EXPECT_GT(seen(ViewSide::kRight, y).x, 700);
  EXPECT_LT(seen(ViewSide::kLeft, y).x, 580);
  EXPECT_GT(seen(ViewSide::kTop, x).x, 700);
  EXPECT_LT(seen(ViewSide::kTop, y).y, 300);
}

// Straight down, too, the camera has an up: +y, as for the name.
TEST_F(Paper, APlaceMayLookStraightDown) {
  const PngPicture picture =
      drawBall({0.03, 0.02, 0.05}, {.camera = CameraPlace{{0, 0, 0.5}, {0, 0, 0}}, .hud = Hud::kOff});
  const double pixels = 360 / std::tan(view::kFieldOfView / 2 * std::numbers::pi / 180) / 0.45;
  EXPECT_NEAR(greenMiddle(picture).x, 640 + 0.03 * pixels, 2);
  EXPECT_NEAR(greenMiddle(picture).y, 360 - 0.02 * pixels, 2);
}

// Off: no letter where the title, the rates and the legend are. Minimal: title and scale bar, no rates.
TEST_F(Paper, HudIsReducedToWhatIsAsked) {
  const CameraPlace place{{0.1, -0.7, 0.3}, {0, 0, 0.05}};  // the same scene behind the letters
  const auto letters = [](const PngPicture& p) {
    return std::array{lightPixels(p, 18, 20, 160, 70), lightPixels(p, 1000, 20, 1260, 120),
                      lightPixels(p, 400, 676, 900, 710)};
  };
  const auto full = letters(draw({.camera = place}, false));
  const auto minimal = letters(draw({.camera = place, .hud = Hud::kMinimal}, false));
  const auto off = letters(draw({.camera = place, .hud = Hud::kOff}, false));
  EXPECT_GT(full[0], 100);
  EXPECT_GT(full[1], 100);
  EXPECT_GT(minimal[0], 100);
  EXPECT_EQ(minimal[1], 0);
  EXPECT_EQ(off[0], 0);
  EXPECT_EQ(off[1], 0);
  EXPECT_GT(full[2], off[2] + 100);
}

// The bar's length at the target is what its number says: 640 mm away a picture of 720 lines is 319 mm high, so 230 lines
// are 102 mm and the bar is 100 mm, 226 lines.
TEST_F(Paper, ScaleBarIsTrueAtTheTarget) {
  for (const auto& [longest, length] : {std::pair{0.102, 0.1}, {0.0999, 0.05}, {0.049, 0.02}, {1.0, 1.0}, {7.0, 5.0}})
    EXPECT_NEAR(view::roundLength(longest), length, 1e-12);
  const PngPicture picture = draw(
      {.camera = CameraPlace{{0, -0.64, 0.04}, {0, 0, 0.04}}, .hud = Hud::kMinimal, .background = Background::kWhite},
      false);
  const double lines = 0.1 * 360 / (std::tan(view::kFieldOfView / 2 * std::numbers::pi / 180) * 0.64);
  int left = 0, right = 0;
  const int row = 720 - 33;  // across the upright ends of the bar, 24 to 35 lines above the edge
  for (int x = 10; x < 300; ++x) {
    if (picture.at(x, row).r + picture.at(x, row).g + picture.at(x, row).b > 200) continue;
    if (left == 0) left = x;
    right = x + 1;
  }
  EXPECT_NEAR(right - left, lines, 2);
}

TEST_F(Paper, LegendIsDrawnOnRequestAlsoWithoutFigures) {
  const CameraPlace place{{0.1, -0.7, 0.3}, {0, 0, 0.05}};
  PictureOptions options{.camera = place, .hud = Hud::kOff};
  const auto panel = [](const PngPicture& p) { return lightPixels(p, 890, 505, 1262, 702); };
  const int without = panel(draw(options, false));
  options.legend = true;
  EXPECT_GT(panel(draw(options, false)), without + 1500);
}

struct Rgba {
  int r, g, b, a;
};

// Alpha is 0 in the corner and 255 on the cube; a translucent cone lies in between. The cube has the colour that it has on
// white.
TEST_F(Paper, TransparentPictureHasAlpha) {
  PictureOptions options{.camera = CameraPlace{{0.1, -0.7, 0.3}, {0, 0, 0.08}}, .hud = Hud::kOff};
  options.background = Background::kWhite;
  const PngPicture white = draw(options);
  options.background = Background::kTransparent;
  draw(options);
  const osg::ref_ptr<osg::Image> image = osgDB::readRefImageFile(file_);
  ASSERT_EQ(image->getPixelFormat(), static_cast<GLenum>(GL_RGBA));
  const auto at = [&](int x, int y) {
    const unsigned char* p = image->data(x, image->t() - 1 - y);
    return Rgba{p[0], p[1], p[2], p[3]};
  };
  EXPECT_EQ(at(2, 2).a, 0);
  EXPECT_EQ(at(1277, 2).a, 0);
  EXPECT_EQ(at(640, 360).a, 255);
  for (const auto& [x, y] : {std::pair{640, 360}, {640, 600}}) {
    EXPECT_NEAR(at(x, y).r, white.at(x, y).r, 1);
    EXPECT_NEAR(at(x, y).g, white.at(x, y).g, 1);
    EXPECT_NEAR(at(x, y).b, white.at(x, y).b, 1);
  }
  EXPECT_EQ(white.at(2, 2).r + white.at(2, 2).g + white.at(2, 2).b, 3 * 255);
  int between = 0, wrong = 0;
  for (int y = 0; y < 720; ++y)
    for (int x = 0; x < 1280; ++x) {
      const Rgba c = at(x, y);
      between += c.a > 20 && c.a < 235;
      // over white again; averaging in linear light differs from mixing codes by more only at edges
      const int over = (c.g * c.a + 255 * (255 - c.a)) / 255;
      wrong += std::abs(over - white.at(x, y).g) > 30;
    }
  EXPECT_GT(between, 2000);
  EXPECT_LT(wrong, 300);
}

// Thumb of the pinch: the contact's spring is stretched by force over stiffness, 3.2 mm along and 0.9 mm across the normal;
// its proxy is half an edge and a fingertip's radius along the normal from the cube's middle, and 4 mm above it.
TEST_F(Paper, OffsetsAreThoseOfTheContact) {
  auto run = makePinchRun(RunOptions::View::kOffscreen, "");
  const PinchStates states = makePinchStates(*run.world, {0.01, 0.02, 0.08}, 0.7);
  FingerContact thumb = states.contacts.fingers[0];
  thumb.nhat_W = Vec3::UnitZ();  // as over the bus, which does not send it
  const view::FingerOffset hip = view::offsetFromHip(thumb, Quat(Eigen::AngleAxisd(0.7, Vec3::UnitZ())));
  EXPECT_NEAR(hip.normal, 0.0032, 1e-12);
  EXPECT_NEAR(hip.tangential, 0.0009, 1e-12);
  const view::FingerOffset object = view::offsetFromObject(thumb);
  EXPECT_NEAR(object.normal, kCubeEdge / 2 + 0.008, 1e-12);
  EXPECT_NEAR(object.tangential, 0.004, 1e-12);
}

// The thumb's bar for 3.2 of 10 mm is filled by 0.32 of its 96 lines, with the colour of sticking.
TEST_F(Paper, OffsetPanelIsDrawnOnRequest) {
  const PictureOptions options{.camera = CameraPlace{{0.1, -0.7, 0.3}, {0, 0, 0.08}}, .hud = Hud::kOff};
  const auto blue = [](const PngPicture& p, int top, int bottom) {
    int longest = 0;
    for (int y = top; y < bottom; ++y) {
      int length = 0;
      for (int x = 1148; x < 1250; ++x) length += p.at(x, y).b > p.at(x, y).r + 90;
      longest = std::max(longest, length);
    }
    return longest;
  };
  EXPECT_EQ(blue(draw(options), 60, 100), 0);
  EXPECT_NEAR(blue(draw(options, true, {"offset"}), 60, 100), 0.32 * 96, 2);
}

}  // namespace
}  // namespace presa::view_test
