// Devices whose driver has a figure: drawn where the report puts them, on demand with deflection and heat.
#include <dlfcn.h>
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

using Names = std::vector<std::string>;

DeviceBinding arm(const std::string& role, const std::string& pos, const std::string& quat) {
  DeviceBinding binding;
  binding.role = role;
  binding.driver = "percro_arm";
  binding.settings["pos"].value = pos;
  binding.settings["quat"].value = quat;
  return binding;
}

/// The thumb in an arm whose axes meet at x = -0.75 m, at the height of the reported tip.
PinchRun runWithArm(const std::string& file, const Names& show) {
  PinchRun run = makePinchRun(RunOptions::View::kOffscreen, file);
  run.world->rig.devices = {arm("thumb", "-0.75 0 0.1", "0.70710678 0.70710678 0 0")};
  run.options.show = show;
  run.options.picture.hud = PictureOptions::Hud::kOff;
  return run;
}

PinchStates statesAt(const PinchRun& run, const Vec3& p_WH) {
  PinchStates states = makePinchStates(*run.world, {0, 0, 0.1});
  states.device.fingers[0].p_WH = p_WH;
  return states;
}

PngPicture draw(const PinchRun& run, const PinchStates& states) {
  EXPECT_EQ(drawOnce(run, states).outcome, View::Screenshot::Outcome::kWritten);
  return PngPicture(run.options.screenshot);
}

int differentPixels(const PngPicture& a, const PngPicture& b) {
  int count = 0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) {
      const Color p = a.at(x, y), q = b.at(x, y);
      count += p.r != q.r || p.g != q.g || p.b != q.b;
    }
  return count;
}

// A pinhole camera above the middle of the barrel. The barrel is symmetrical about its axis in this view, so the middle
// of its outline in each column lies on the line from the axes to the tip: to a pixel (0.3 mm), over 0.2 m.
TEST(ShownDevices, TheBarrelPointsFromTheAxesToTheReportedTip) {
  constexpr double kEye = 0.5;
  for (const double aside : {-0.12, 0.0, 0.2}) {
    const Vec3 tip(-0.05, aside, 0.1), axes(-0.75, 0, 0.1), along = (tip - axes).normalized();
    const Vec3 middle = axes + 0.22 * along;  // the outer tube
    PinchRun run = runWithArm(tempFile("barrel.png"), {"no-visual", "no-hips", "no-proxies", "no-cones", "no-forces"});
    run.options.picture.background = PictureOptions::Background::kWhite;
    run.options.picture.camera = CameraPlace{middle + kEye * Vec3::UnitZ(), middle};
    const PngPicture picture = draw(run, statesAt(run, tip));
    const double metres = kEye * std::tan(view::kFieldOfView / 2 * std::numbers::pi / 180) / (picture.height() / 2.0);
    const double slope = along.y() / along.x();
    int columns = 0;
    for (int x = picture.width() / 2 - 150; x <= picture.width() / 2 + 150; x += 50) {
      int low = picture.height(), high = -1;
      for (int y = 0; y < picture.height(); ++y) {
        const Color c = picture.at(x, y);
        if (c.r > 250 && c.g > 250 && c.b > 250) continue;
        low = std::min(low, y), high = std::max(high, y);
      }
      if (high < low) continue;
      ++columns;
      const double right = metres * (x + 0.5 - picture.width() / 2.0);
      const double up = metres * (picture.height() / 2.0 - (low + high + 1) / 2.0);
      EXPECT_NEAR(up, slope * right, 1.5 * metres) << aside << ", column " << x;
    }
    EXPECT_EQ(columns, 7);
  }
}

// Gone with no-devices: every pixel is that of a rig whose driver has no figure.
TEST(ShownDevices, OnlyWhereADriverHasAFigureAndTheyAreShown) {
  PinchRun shown = runWithArm(tempFile("shown.png"), {}), hidden = runWithArm(tempFile("hidden.png"), {"no-devices"});
  PinchRun without = makePinchRun(RunOptions::View::kOffscreen, tempFile("without.png"));
  without.options.picture.hud = PictureOptions::Hud::kOff;
  without.world->rig.devices = {arm("thumb", "-0.75 0 0.1", "1 0 0 0")};
  without.world->rig.devices[0].driver = "scripted";
  const PinchStates states = statesAt(shown, {-0.043, 0, 0.1});
  const PngPicture with = draw(shown, states), off = draw(hidden, states), none = draw(without, states);
  EXPECT_EQ(differentPixels(off, none), 0);
  EXPECT_GT(differentPixels(with, none), with.width() * with.height() / 50);
}

TEST(ShownDevices, NothingIsLoadedOrMadeForADriverWithoutAFigure) {
  PinchRun run = makePinchRun(RunOptions::View::kOffscreen, "");
  const view::Picture none(run.world, run.options);
  run.world->rig.devices = {arm("thumb", "0 0 0", "1 0 0 0")};
  run.world->rig.devices[0].driver = "scripted";
  EXPECT_EQ(view::DeviceFigures::of(*run.world), nullptr);
  view::Picture without(run.world, run.options),
      bare(makePinchRun(RunOptions::View::kOffscreen, "").world, run.options);
  EXPECT_EQ(without.space()->getNumChildren(), bare.space()->getNumChildren());
  EXPECT_EQ(without.hud().right().getNumChildren(), bare.hud().right().getNumChildren());
  const std::string library = pluginFolders().back() + "/presa_scripted.so";
  EXPECT_EQ(dlopen(library.c_str(), RTLD_NOW | RTLD_NOLOAD), nullptr);
}

// The participant of an experiment is not shown what is measured.
TEST(ShownDevices, AParticipantDoesNotSeeThem) {
  PinchRun run = runWithArm(tempFile("participant.png"), {}),
           bare = makePinchRun(RunOptions::View::kOffscreen, tempFile("bare.png"));
  const ParticipantScreen screen{.bodies = true, .fingertips = true};
  bare.options.picture = run.options.picture;
  run.options.participant = bare.options.participant = screen;
  const PinchStates states = statesAt(run, {-0.043, 0, 0.1});
  ASSERT_EQ(drawOnce(run, states, &screen).outcome, View::Screenshot::Outcome::kWritten);
  ASSERT_EQ(drawOnce(bare, states, &screen).outcome, View::Screenshot::Outcome::kWritten);
  EXPECT_EQ(differentPixels(PngPicture(run.options.screenshot), PngPicture(bare.options.screenshot)), 0);
}

// The barrel slides out and turns, the line bends. 24 codes as in retained_test.
TEST(ShownDevices, AFilmEqualsPicturesDrawnAnew) {
  const auto film = [](const std::string& name, int first, int last) {
    const std::string folder = tempFile(name + std::to_string(first));
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    PinchRun run = runWithArm("", {"no-visual", "compliance"});
    run.options.screenshots = folder;
    run.options.screenshot_every = 0.02;
    run.options.picture.width = 640, run.options.picture.height = 360;
    run.options.picture.camera = CameraPlace{{-0.2, -1.2, 0.5}, {-0.4, 0, 0.1}};
    view::ViewModule module(run.world, run.options);
    Feed feed(module);
    module.start();
    for (int i = first; i <= last; ++i) {
      PinchStates states = statesAt(run, {-0.15 + 0.03 * i, 0.02 * i, 0.1 - 0.02 * i});
      states.forces.f_H_W[0] = Vec3(0, 0, -0.3 * i);
      feed.publish(states, 0.04 * i);
      module.step({static_cast<std::uint64_t>(i), 0.04 * i, 0.04});
    }
    module.stop();
    return folder;
  };
  const std::string whole = film("devices_film", 0, 6);
  for (const int frame : {0, 3, 6}) {
    std::array<char, 32> name;
    std::snprintf(name.data(), name.size(), "/%09.3f.png", 0.04 * frame);
    const PngPicture kept(whole + name.data()), anew(film("devices_alone", frame, frame) + name.data());
    int different = 0;
    for (int y = 0; y < kept.height(); ++y)
      for (int x = 0; x < kept.width(); ++x) {
        const Color a = kept.at(x, y), b = anew.at(x, y);
        different += std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)}) > 24;
      }
    EXPECT_LT(different, 20) << "frame " << frame;
  }
}

view::ViewFrame frameOf(const PinchStates& states, double time) {
  view::ViewFrame frame;
  frame.time = time;
  for (const auto& body : states.objects.bodies) frame.X_WB.push_back(body.X_WB_end);
  frame.device = states.device;
  frame.contacts = states.contacts;
  frame.forces = states.forces;
  return frame;
}

// The figure of a device in a turned and shifted frame of the rig is that of the frame: its tip stays at the fingertip.
TEST(ShownDevices, ADeviceInAFrameOfTheRigStandsInIt) {
  PinchRun run = runWithArm("", {});
  Frame desk;
  desk.name = "desk";
  desk.parent = kWorldFrame;
  desk.X_PF = {{0.2, -0.3, 0.05}, Quat(Eigen::AngleAxisd(0.6, Vec3::UnitZ()))};
  run.world->rig.frames = {desk};
  run.world->rig.devices[0].frame = "desk";
  const auto figures = view::DeviceFigures::of(*run.world);
  ASSERT_NE(figures, nullptr);
  const Vec3 tip = desk.X_PF * Vec3(-0.05, 0.08, 0.16);
  figures->setQuick(false);
  figures->update(frameOf(statesAt(run, tip), 0.5), view::ShownParts());
  double nearest = 1;
  for (unsigned i = 0; i < figures->root()->getNumChildren(); ++i) {
    const auto* part = dynamic_cast<const osg::MatrixTransform*>(figures->root()->getChild(i));
    const osg::Vec3d p = part->getMatrix().getTrans();
    if (part->getName() == "thumb inner tube") nearest = (Vec3(p.x(), p.y(), p.z()) - tip).norm();
    if (part->getName() == "thumb base") {
      EXPECT_LT((Vec3(p.x(), p.y(), p.z()) - desk.X_PF * Vec3(-0.75, 0, 0.1)).norm(), 1e-12);
    }
  }
  EXPECT_LT(nearest, 1e-12);
}

TEST(ShownDevices, APausedOrLostDeviceStaysWhereItWas) {
  const PinchRun run = runWithArm("", {});
  const auto figures = view::DeviceFigures::of(*run.world);
  figures->setQuick(true);
  PinchStates states = statesAt(run, {-0.05, 0, 0.1});
  figures->update(frameOf(states, 0.5), view::ShownParts());
  const osg::Vec3 before = figures->root()->getBound().center();
  states.device.fingers[0] = FingerInput{};
  figures->update(frameOf(states, 0.6), view::ShownParts());
  EXPECT_EQ(figures->root()->getBound().center(), before);
}

bool isLine(const Color& c) { return c.r > 140 && 2 * c.g < c.r && 3 * c.b > 2 * c.r && c.b > c.g + 60; }
bool isCold(const Color& c) { return c.b > 120 && 2 * c.r < c.b && 3 * c.g < 2 * c.b; }

int countIn(const PngPicture& picture, bool (*is)(const Color&)) {
  int count = 0;
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) count += is(picture.at(x, y));
  return count;
}

// Seen from the side, the line ends 100 times the deflection above the tip. Over 0.7 m the paper's stiffness gives 2 N
// upwards on the arm; a pixel is 0.3 mm, and half the thickness of the line 4 mm.
TEST(ShownDevices, TheDeflectionIsDrawnAHundredTimesAsLarge) {
  PinchRun run = runWithArm(tempFile("deflection.png"), {"compliance", "no-devices", "no-visual", "no-hips",
                                                         "no-proxies", "no-cones", "no-forces"});
  run.options.picture.background = PictureOptions::Background::kWhite;
  const Vec3 tip(-0.05, 0, 0.1);
  constexpr double kEye = 0.6;
  run.options.picture.camera = CameraPlace{tip - kEye * Vec3::UnitY(), tip};
  PinchStates states = statesAt(run, tip);
  states.forces.f_H_W[0] = Vec3(0, 0, -2);
  const PngPicture picture = draw(run, states);
  const double metres = kEye * std::tan(view::kFieldOfView / 2 * std::numbers::pi / 180) / (picture.height() / 2.0);
  double top = -1;
  for (int y = picture.height() - 1; y >= 0; --y)
    for (int x = 0; x < picture.width() * 6 / 10; ++x)  // the panel with the numbers is at the right
      if (isLine(picture.at(x, y))) top = metres * (picture.height() / 2.0 - y - 0.5);
  // c = a1 L + a3 L^3 through 13.5 N/mm at 0.441 m and 1.5 N/mm at 1.070 m
  const double low = 1 / (13.5e3 * 0.441), high = 1 / (1.5e3 * 1.070);
  const double a3 = (high - low) / (1.070 * 1.070 - 0.441 * 0.441), a1 = low - a3 * 0.441 * 0.441;
  const double bent = 2 * 0.7 * (a1 + a3 * 0.7 * 0.7);
  EXPECT_NEAR(top, 100 * bent + 0.004, 1.5e-3);
  run.options.show.front() = "no-compliance";
  EXPECT_EQ(countIn(draw(run, states), isLine), 0);
}

TEST(ShownDevices, MotorsShowTheirHeatOnDemand) {
  const Names only{"no-visual", "no-hips", "no-proxies", "no-cones", "no-forces"};
  PinchRun run = runWithArm("", only);
  run.options.picture.background = PictureOptions::Background::kWhite;
  run.options.picture.camera = CameraPlace{{-0.85, -0.8, 0.35}, {-0.75, 0, 0.1}};
  PinchStates states = statesAt(run, {-0.05, 0, 0.1});
  const auto pictureAt = [&](double time, const std::string& name, bool heat) {
    run.options.screenshot = tempFile(name);
    run.options.show = only;
    if (heat) run.options.show.push_back("heat");
    view::ViewModule module(run.world, run.options);
    Feed feed(module);
    module.start();
    for (const double t : {time, time + 0.02}) {
      feed.publish(states, t);
      module.step({static_cast<std::uint64_t>(60 * t), t, 0.02});
    }
    module.stop();
    return PngPicture(run.options.screenshot);
  };
  EXPECT_EQ(countIn(pictureAt(0, "own.png", false), isCold), 0);
  EXPECT_GT(countIn(pictureAt(0, "cold.png", true), isCold), 300);
  EXPECT_EQ(countIn(pictureAt(5, "unknown.png", true), isCold), 0) << "first seen at 5 s: not known, grey";
}

TEST(ShownDevices, HeatIsBlueGreenYellowRed) {
  EXPECT_GT(view::heatColor(0).z(), 5 * view::heatColor(0).x());
  EXPECT_GT(view::heatColor(1.0 / 3).y(), view::heatColor(1.0 / 3).x());
  EXPECT_GT(view::heatColor(2.0 / 3).x(), 10 * view::heatColor(2.0 / 3).z());
  EXPECT_GT(view::heatColor(1).x(), 10 * view::heatColor(1).y());
  EXPECT_EQ(view::heatColor(7), view::heatColor(1));
}

}  // namespace
}  // namespace presa::view_test
