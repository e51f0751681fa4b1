// `--show joints`: glyphs are where optics and the joint's formula say, and are kept right by the retained pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "modules/view_osg/picture.h"
#include "tests/modules/view_osg/pinch_world.h"
#include "tests/modules/view_osg/png_picture.h"

namespace presa::view_test {
namespace {

constexpr double kCubeHeight = 0.1, kEye = 0.8, kArm = 0.02;  // cube, camera above it; cube from its hinge along x [m]

Joint cubeJoint(JointType type, const Vec3& axis, double lower, double upper) {
  Joint joint;
  joint.name = "joint";
  joint.type = type;
  joint.body = 1;
  if (type == JointType::kHinge) joint.p_BJ = {-kArm, 0, 0};
  joint.axes.resize(1);
  joint.axes[0].dhat_B = axis;
  joint.axes[0].turns = type == JointType::kHinge;
  joint.axes[0].lower = lower, joint.axes[0].upper = upper;
  return joint;
}

/// The cube at kCubeHeight, with this joint, seen from above.
PinchRun runWith(const Joint& joint, const std::string& file, const std::vector<std::string>& show) {
  PinchRun run = makePinchRun(RunOptions::View::kOffscreen, file);
  run.world->scene.bodies[1].X_WB.p = Vec3(0, 0, kCubeHeight) - joint.p_BJ;
  run.world->scene.joints.push_back(joint);
  run.options.show = show;
  run.options.picture = {.camera = CameraPlace{{0, 0, kCubeHeight + kEye}, {0, 0, kCubeHeight}},
                         .hud = PictureOptions::Hud::kOff,
                         .background = PictureOptions::Background::kWhite};
  return run;
}

/// Place of the cube at an angle of its hinge.
Vec3 swung(double angle) { return {kArm * std::cos(angle), kArm * std::sin(angle), kCubeHeight}; }

PinchStates statesOf(const PinchRun& run, const Vec3& p_WO, double yaw) {
  PinchStates states = makePinchStates(*run.world, p_WO, yaw);
  states.device = DeviceState(), states.contacts = ContactExchange();
  return states;
}

PngPicture drawJoint(const Joint& joint, const Vec3& p_WO, double yaw,
                     std::vector<std::string> show = {"joints", "no-visual"}) {
  const std::string file = tempFile("joint.png");
  const PinchRun run = runWith(joint, file, show);
  EXPECT_EQ(drawOnce(run, statesOf(run, p_WO, yaw)).outcome, View::Screenshot::Outcome::kWritten);
  return PngPicture(file);
}

bool isHand(const Color& c) { return c.g > 90 && 3 * c.g > 4 * c.r && 3 * c.g > 4 * c.b; }
bool isFrame(const Color& c) { return c.b > 90 && 3 * c.b > 4 * c.r && 2 * c.b > 3 * c.g; }

/// Points of these pixels in the plane of the joint, from the joint [m]: a pinhole camera.
std::vector<Eigen::Vector2d> pointsOf(const PngPicture& picture, bool (*is)(const Color&)) {
  const double metres = kEye * std::tan(view::kFieldOfView / 2 * std::numbers::pi / 180) / (picture.height() / 2.0);
  std::vector<Eigen::Vector2d> points;
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x)
      if (is(picture.at(x, y)))
        points.emplace_back(metres * (x + 0.5 - picture.width() / 2.0), metres * (picture.height() / 2.0 - y - 0.5));
  return points;
}

/// Direction of their middle.
double headingOf(const std::vector<Eigen::Vector2d>& points) {
  Eigen::Vector2d sum(0, 0);
  for (const Eigen::Vector2d& p : points) sum += p;
  return std::atan2(sum.y(), sum.x());
}

// The hand is symmetric about its direction, so the mean of its pixels lies on it: to a tenth of a pixel (0.06 mm) of
// hundreds of pixels whose mean is 20 mm from the axis, 0.2 degrees; the light on its round shape shifts it by as much.
TEST(ShownJoints, TheHandOfAHingePointsAlongItsAngle) {
  for (const double angle : {-0.4, 0.0, 0.9}) {
    const PngPicture picture = drawJoint(cubeJoint(JointType::kHinge, Vec3::UnitZ(), -0.5, 1.2), swung(angle), angle);
    const auto hand = pointsOf(picture, isHand);
    ASSERT_GT(hand.size(), 50u) << angle;
    EXPECT_NEAR(headingOf(hand), angle, 0.4 * std::numbers::pi / 180);
  }
}

// The stops are the parts of the frame that are farthest from the axis: at both limits, to the width of their rods.
TEST(ShownJoints, TheArcOfAHingeEndsAtItsStops) {
  const auto frame = pointsOf(drawJoint(cubeJoint(JointType::kHinge, Vec3::UnitZ(), -0.5, 1.2), swung(0), 0), isFrame);
  ASSERT_GT(frame.size(), 100u);
  double reach = 0, low = 9, high = -9;
  for (const auto& p : frame) reach = std::max(reach, p.norm());
  for (const auto& p : frame) {
    if (p.norm() < 0.9 * reach) continue;
    low = std::min(low, std::atan2(p.y(), p.x())), high = std::max(high, std::atan2(p.y(), p.x()));
  }
  EXPECT_NEAR(low, -0.5, 0.08);
  EXPECT_NEAR(high, 1.2, 0.08);
}

// To a pixel (0.6 mm), half the thickness of a stop (1.3 mm), and what its half height of 8 mm towards the eye at 0.8 m
// adds (1 %).
TEST(ShownJoints, ASliderShowsItsTravelToScale) {
  const PngPicture picture =
      drawJoint(cubeJoint(JointType::kSlider, Vec3::UnitX(), -0.05, 0.12), {0.07, 0, kCubeHeight}, 0);
  double low = 9, high = -9, tick = 0;
  const auto frame = pointsOf(picture, isFrame), hand = pointsOf(picture, isHand);
  for (const auto& p : frame) low = std::min(low, p.x()), high = std::max(high, p.x());
  ASSERT_FALSE(hand.empty());
  for (const auto& p : hand) tick += p.x() / static_cast<double>(hand.size());
  EXPECT_NEAR(low, -0.05, 2.4e-3);
  EXPECT_NEAR(high, 0.12, 3.1e-3);
  EXPECT_NEAR(tick, 0.07, 2e-3);
}

TEST(ShownJoints, OnlyWhereAskedFor) {
  const Joint joint = cubeJoint(JointType::kHinge, Vec3::UnitZ(), -0.5, 1.2);
  for (const auto& show : {std::vector<std::string>{"no-visual"}, {"no-visual", "joints", "no-joints"}}) {
    EXPECT_TRUE(pointsOf(drawJoint(joint, swung(0), 0, show), isHand).empty());
    EXPECT_TRUE(pointsOf(drawJoint(joint, swung(0), 0, show), isFrame).empty());
  }
}

TEST(ShownJoints, CostNoNodeUntilTheyAreShown) {
  const auto nodes = [](osg::Group& group) { return group.getNumChildren(); };
  const PinchRun run = runWith(cubeJoint(JointType::kHinge, Vec3::UnitZ(), -0.5, 1.2), "", {});
  view::Picture picture(run.world, run.options);
  view::ViewFrame frame;
  for (const Body& body : run.world->scene.bodies) frame.X_WB.push_back(body.X_WB);
  const unsigned space = nodes(*picture.space()), labels = nodes(picture.hud().center());
  picture.follow(frame, {});
  picture.show(frame, {});
  EXPECT_EQ(nodes(*picture.space()), space);
  EXPECT_EQ(nodes(picture.hud().center()), labels);
  picture.parts().toggle(ShownPart::kJoints);
  picture.show(frame, {});
  EXPECT_EQ(nodes(*picture.space()), space + 1);
  EXPECT_EQ(nodes(picture.hud().center()), labels + 1);
}

// The hand moves inside of what stands still. Only pixels of the glyph count: the light, and with it the edge of a shadow,
// may be placed differently. 24 codes as in retained_test.
TEST(ShownJoints, AFilmEqualsPicturesDrawnAnew) {
  const auto film = [](const std::string& name, int first, int last) {
    const std::string folder = tempFile(name + std::to_string(first));
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    PinchRun run = runWith(cubeJoint(JointType::kHinge, Vec3::UnitZ(), -1, 3), "", {"joints", "no-visual"});
    run.options.screenshots = folder;
    run.options.screenshot_every = 0.02;
    run.options.picture.width = 640, run.options.picture.height = 360;
    run.options.picture.background = PictureOptions::Background::kScene;
    view::ViewModule module(run.world, run.options);
    Feed feed(module);
    module.start();
    for (int i = first; i <= last; ++i) {
      feed.publish(statesOf(run, swung(0.3 * i), 0.3 * i), 0.04 * i);
      module.step({static_cast<std::uint64_t>(i), 0.04 * i, 0.04});
    }
    module.stop();
    return folder;
  };
  const std::string whole = film("film", 0, 6);
  for (const int frame : {1, 3, 6}) {
    std::array<char, 32> name;
    std::snprintf(name.data(), name.size(), "/%09.3f.png", 0.04 * frame);
    const PngPicture kept(whole + name.data()), anew(film("alone", frame, frame) + name.data());
    int different = 0;
    for (int y = 0; y < kept.height(); ++y)
      for (int x = 0; x < kept.width(); ++x) {
        const Color a = kept.at(x, y), b = anew.at(x, y);
        const bool glyph = isHand(a) || isHand(b) || isFrame(a) || isFrame(b);
        different += glyph && std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)}) > 24;
      }
    EXPECT_LT(different, 20) << "frame " << frame;
    EXPECT_NEAR(headingOf(pointsOf(kept, isHand)), 0.3 * frame, 0.06);
  }
}

}  // namespace
}  // namespace presa::view_test
