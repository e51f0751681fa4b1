#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <osg/Matrixd>

#include "modules/view_osg/changed_region.h"
#include "modules/view_osg/follow_camera.h"
#include "tests/modules/view_osg/pinch_world.h"
#include "tests/modules/view_osg/png_picture.h"

// Software rendering keeps pictures and draws only what changed; nobody may see the difference.
namespace presa::view_test {
namespace {

using view::Ball;
using view::CameraPose;
using view::changedPixels;
using view::Changes;
using view::cropTo;
using view::PixelRect;

constexpr int kWidth = 640, kHeight = 360;
constexpr double kFrame = 0.04;  // between two pictures [s]

/// The cube is lifted, moved aside and turned; from the eighth frame on it rests.
PinchStates statesAt(const World& world, int frame) {
  const double way = std::min(frame, 8) / 8.0;
  return makePinchStates(world, {0.05 * way, 0.02 * way, 0.05 + 0.10 * way}, 0.6 * way);
}

/// Draws these frames of a film with one view; returns the folder of its pictures.
std::string film(const std::string& name, int first, int last) {
  const std::string folder = testing::TempDir() + "presa_retained_" + name + std::to_string(first);
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  PinchRun run = makePinchRun(RunOptions::View::kOffscreen, "");
  run.options.screenshots = folder;
  run.options.screenshot_every = kFrame / 2;
  run.options.picture.width = kWidth, run.options.picture.height = kHeight;
  run.options.picture.camera = CameraPlace{{0.25, -0.7, 0.35}, {0.02, 0, 0.08}};
  view::ViewModule module(run.world, run.options);
  Feed feed(module);
  module.start();
  for (int i = first; i <= last; ++i) {
    feed.publish(statesAt(*run.world, i), kFrame * i);
    module.step({static_cast<std::uint64_t>(i), kFrame * i, kFrame});
  }
  module.stop();
  return folder;
}

std::string fileAt(const std::string& folder, int frame) {
  std::array<char, 32> name;
  std::snprintf(name.data(), name.size(), "/%09.3f.png", kFrame * frame);
  return folder + name.data();
}

// A trace of where something was would differ by its contrast. The light of a kept picture may be placed differently,
// which moves soft edges of shadows by less than these 24 codes.
TEST(Retained, APictureOfAFilmEqualsTheOneThatIsDrawnAnew) {
  const std::string whole = film("film", 0, 11);
  for (const int frame : {1, 4, 8, 11}) {
    const std::string alone = film("alone", frame, frame);
    const PngPicture kept(fileAt(whole, frame)), anew(fileAt(alone, frame));
    int different = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const Color a = kept.at(x, y), b = anew.at(x, y);
        different += std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)}) > 24;
      }
    EXPECT_LT(different, 40) << "frame " << frame;
  }
}

TEST(ChangedPixels, ContainThePointsAndALittleMore) {
  const osg::Matrixd look =
      osg::Matrixd::lookAt(osg::Vec3d(0, -1, 0), osg::Vec3d(), osg::Vec3d(0, 0, 1)) *
      osg::Matrixd::perspective(90, 2, 0.01, 10);  // at distance 1: x from -2 to 2, z from -1 to 1
  const PixelRect rect = changedPixels({.all = false, .points = {{-0.5, 0, 0}, {0.5, 0, 0.25}}}, look, 400, 200);
  EXPECT_EQ(rect.x, 150 - 2);
  EXPECT_EQ(rect.width, 100 + 4);
  EXPECT_EQ(rect.y, 100 - 2);
  EXPECT_EQ(rect.height, 25 + 4);
}

TEST(ChangedPixels, AreThePictureWhereAPointIsNotInFrontOfTheEye) {
  const osg::Matrixd look = osg::Matrixd::lookAt(osg::Vec3d(0, -1, 0), osg::Vec3d(), osg::Vec3d(0, 0, 1)) *
                            osg::Matrixd::perspective(90, 2, 0.01, 10);
  for (const Changes& changes : {Changes{}, Changes{.all = false, .points = {{0, 0, 0}, {0, -2, 0}}}}) {
    const PixelRect rect = changedPixels(changes, look, 400, 200);
    EXPECT_EQ(rect.x, 0);
    EXPECT_EQ(rect.width, 400);
    EXPECT_EQ(rect.height, 200);
  }
  EXPECT_TRUE(changedPixels({.all = false, .points = {}}, look, 400, 200).empty());
  EXPECT_TRUE(changedPixels({.all = false, .points = {{9, 0, 0}}}, look, 400, 200).empty());
}

TEST(ChangedPixels, AreCroppedToTheirViewport) {
  const osg::Matrixd crop = cropTo({100, 50, 200, 100}, 400, 400);
  const osg::Vec4d corner = osg::Vec4d(2 * 100.0 / 400 - 1, 2 * 50.0 / 400 - 1, 0.3, 1) * crop;
  EXPECT_NEAR(corner.x(), -1, 1e-12);
  EXPECT_NEAR(corner.y(), -1, 1e-12);
  EXPECT_NEAR(corner.z(), 0.3, 1e-12);
  const osg::Vec4d opposite = osg::Vec4d(2 * 300.0 / 400 - 1, 2 * 150.0 / 400 - 1, 0.3, 1) * crop;
  EXPECT_NEAR(opposite.x(), 1, 1e-12);
  EXPECT_NEAR(opposite.y(), 1, 1e-12);
}

std::vector<Ball> subjectAt(double x) { return {{{x, 0, 0.05}, 0.03}, {{x + 0.06, 0, 0.05}, 0.008}}; }

TEST(FollowCamera, RestsWhileTheSubjectFits) {
  view::FollowCamera camera({});
  const CameraPose start = camera.at(0, subjectAt(0), 16.0 / 9, 0.52, true);
  for (int i = 1; i < 100; ++i) {
    const CameraPose now = camera.at(0.02 * i, subjectAt(0.006 * std::sin(i)), 16.0 / 9, 0.52, false);
    EXPECT_EQ((now.eye - start.eye).norm(), 0);
  }
}

TEST(FollowCamera, GlidesToASubjectThatLeavesAndRestsAgain) {
  view::FollowCamera camera({});
  CameraPose before = camera.at(0, subjectAt(0), 16.0 / 9, 0.52, true);
  double fastest = 0;
  for (int i = 1; i <= 100; ++i) {
    const CameraPose now = camera.at(0.02 * i, subjectAt(0.3), 16.0 / 9, 0.52, false);
    fastest = std::max(fastest, (now.eye - before.eye).norm() / 0.02);
    before = now;
  }
  const CameraPose goal = view::frameSubject(subjectAt(0.3), 16.0 / 9, view::chooseHeading(subjectAt(0)), 0.52);
  EXPECT_LT((before.eye - goal.eye).norm(), 1e-12);
  EXPECT_NEAR(view::reachInPicture(subjectAt(0.3), goal, 16.0 / 9, 0.52), 1, 0.05);
  EXPECT_LT(fastest, 1.55 * 0.3 / 0.7);  // the greatest slope of a smooth step is 1.5 times its mean
}

}  // namespace
}  // namespace presa::view_test
