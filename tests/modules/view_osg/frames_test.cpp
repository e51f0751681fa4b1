// `--show frames`: the axes of the rig's frames where they are, and the sentence on screen about what happens to one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/core/graph/port.h"
#include "tests/modules/view_osg/png_picture.h"

namespace presa::view_test {
namespace {

constexpr double kFrameHeight = 0.1, kEyeAbove = 0.8;  // of the frame's origin; of the camera above it [m]
constexpr double kYaw = 0.5;                           // of the frame about z [rad]
const Vec3 kDesk(0.15, 0.08, kFrameHeight);            // its origin, beside all bodies

/// A rig with the frame 'desk', whose clutch is part of it, seen from above the desk.
PinchRun deskRun(const std::string& file, const std::vector<std::string>& show, PictureOptions::Hud hud) {
  PinchRun run = makePinchRun(RunOptions::View::kOffscreen, file);
  Frame& desk = run.world->rig.frames.emplace_back();
  desk.name = "desk", desk.parent = kWorldFrame;
  desk.clutch.emplace();
  run.options.show = show;
  run.options.picture = {.camera = CameraPlace{kDesk + Vec3(0, 0, kEyeAbove), kDesk},
                         .hud = hud,
                         .background = PictureOptions::Background::kWhite};
  return run;
}

PngPicture drawDesk(const std::string& name, std::vector<std::string> show, std::uint32_t doing,
                    PictureOptions::Hud hud = PictureOptions::Hud::kOff) {
  const std::string file = tempFile(name + ".png");
  const PinchRun run = deskRun(file, show, hud);
  PinchStates states = makePinchStates(*run.world, {0, 0, kCubeEdge / 2});
  states.device = DeviceState(), states.contacts = ContactExchange();
  view::ViewModule module(run.world, run.options);
  FrameState frames(1);
  frames.frames[0].X_WF = {kDesk, Quat(Eigen::AngleAxisd(kYaw, Vec3::UnitZ()))};
  frames.frames[0].doing = doing;
  Bridge<FrameState> bridge(frames);
  for (InPortBase* in : static_cast<Module&>(module).inputs())
    if (in->name() == kFramesPort) bridge.addReader(dynamic_cast<In<FrameState>&>(*in));
  Feed feed(module);
  module.start();
  feed.publish(states, 0.5);
  const Tick tick{30, 0.5, 1.0 / 60};
  bridge.push(tick);
  bridge.pull(RateGroup::kView, tick);
  module.step(tick);
  module.stop();
  EXPECT_EQ(module.screenshot().outcome, View::Screenshot::Outcome::kWritten);
  return PngPicture(file);
}

bool isRedAxis(const Color& c) { return c.r > 90 && 3 * c.r > 5 * c.g && 3 * c.r > 5 * c.b; }
bool isGreenAxis(const Color& c) { return c.g > 90 && 3 * c.g > 5 * c.r && 3 * c.g > 5 * c.b; }

/// Points of these pixels in the plane of the desk, from its origin, closer than an axis is long [m]: a pinhole camera.
std::vector<Eigen::Vector2d> axisIn(const PngPicture& picture, bool (*is)(const Color&)) {
  constexpr double kAxis = 0.065;
  const double metres =
      kEyeAbove * std::tan(view::kFieldOfView / 2 * std::numbers::pi / 180) / (picture.height() / 2.0);
  std::vector<Eigen::Vector2d> points;
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      const Eigen::Vector2d p(metres * (x + 0.5 - picture.width() / 2.0), metres * (picture.height() / 2.0 - y - 0.5));
      if (is(picture.at(x, y)) && p.norm() < kAxis) points.push_back(p);
    }
  return points;
}

double directionOf(const std::vector<Eigen::Vector2d>& points) {
  Eigen::Vector2d sum(0, 0);
  for (const Eigen::Vector2d& p : points) sum += p;
  return std::atan2(sum.y(), sum.x());
}

// An axis is symmetric about its direction: the mean of its pixels is on it, to a tenth of a pixel (0.06 mm) at 30 mm,
// and as much for the light on its round shape.
TEST(ShownFrames, TheAxesOfAFramePointAsItDoes) {
  const PngPicture picture = drawDesk("axes", {"frames", "no-visual"}, 0);
  const auto x = axisIn(picture, isRedAxis), y = axisIn(picture, isGreenAxis);
  ASSERT_GT(x.size(), 50u);
  ASSERT_GT(y.size(), 50u);
  EXPECT_NEAR(directionOf(x), kYaw, 0.01);
  EXPECT_NEAR(directionOf(y), kYaw + std::numbers::pi / 2, 0.01);
  double reach = 0;
  for (const auto& p : x) reach = std::max(reach, p.norm());
  // an axis is 60 mm long; its tip, a cone of 12 mm with a radius of 2.2 mm, is thinner than a pixel, 0.55 mm, for 1.5
  EXPECT_NEAR(reach, 0.06, 1.5e-3 + 0.55e-3);
}

TEST(ShownFrames, OnlyWhereAskedFor) {
  for (const auto& show : {std::vector<std::string>{"no-visual"}, {"no-visual", "frames", "no-frames"}}) {
    const PngPicture picture = drawDesk("none", show, 0);
    EXPECT_TRUE(axisIn(picture, isRedAxis).empty());
    EXPECT_TRUE(axisIn(picture, isGreenAxis).empty());
  }
}

// The sentence needs no `--show`: it stands in the upper part of the picture, its middle in the middle, and nothing
// else of the picture changes. It is 37 letters of 0.602 x 18 lines, of the picture's 720, within its panel.
TEST(ShownFrames, TheSentenceIsOnScreenWhileAFrameSlides) {
  const PngPicture calm = drawDesk("calm", {}, 0, PictureOptions::Hud::kFull),
                   again = drawDesk("again", {}, 0, PictureOptions::Hud::kFull),
                   slides = drawDesk("slides", {}, kFrameClutched, PictureOptions::Hud::kFull);
  int left = calm.width(), right = 0, top = calm.height(), bottom = 0, count = 0;
  for (int y = 0; y < calm.height(); ++y)
    for (int x = 0; x < calm.width(); ++x) {
      const auto differ = [&](const PngPicture& other) {
        const Color a = calm.at(x, y), b = other.at(x, y);
        return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)}) > 8;
      };
      EXPECT_FALSE(differ(again)) << x << ' ' << y;
      if (!differ(slides)) continue;
      ++count;
      left = std::min(left, x), right = std::max(right, x), top = std::min(top, y), bottom = std::max(bottom, y);
    }
  ASSERT_GT(count, 500);
  const double line = calm.height() / 720.0, middle = calm.height() / 2.0 - 236 * line;
  EXPECT_NEAR((left + right) / 2.0, calm.width() / 2.0, 12 * line);
  EXPECT_NEAR(right - left, (0.602 * 18 * 37 + 24) * line, 30 * line);
  EXPECT_GT(top, middle - 40 * line);
  EXPECT_LT(bottom, middle + 40 * line);
}

}  // namespace
}  // namespace presa::view_test
