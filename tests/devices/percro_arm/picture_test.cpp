// The arms in pictures of the program: of a run, and of its replay.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include "apps/presa/replay_page/figures.h"
#include "devices/percro_arm/drawn_parts.h"
#include "framework/record/record_plugin.h"
#include "framework/session/load_world.h"
#include "tests/apps/support/support.h"
#include "tests/support/png_picture.h"

namespace presa::test {
namespace {

const std::string kScene = " " + source("config/scenes/cube.xml"),
                  kLook = " --hud off --picture-size 960x540 --camera 0.35,-2.35,0.95:0,0,0.07 --screenshot ";

std::string pictureOf(const std::string& command, const std::string& name, const std::string& more) {
  const std::string file = scratch(name);
  const Outcome outcome = presa(command + kLook + file + more);
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  return file;
}

std::string runWith(const std::string& rig) {
  return "run" + kScene + " --rig " + source("config/rigs/" + rig) + " --lockstep --quiet";
}

/// Pixels that differ by more than a person sees at an edge.
int differentPixels(const std::string& a, const std::string& b) {
  const PngPicture p(a), q(b);
  int count = 0;
  for (int y = 0; y < p.height(); ++y)
    for (int x = 0; x < p.width(); ++x) {
      const Color u = p.at(x, y), v = q.at(x, y);
      count += std::max({std::abs(u.r - v.r), std::abs(u.g - v.g), std::abs(u.b - v.b)}) > 24;
    }
  return count;
}

/// Pixels in the yellow of the gimbals.
int yellowIn(const std::string& file) {
  const PngPicture picture(file);
  int count = 0;
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      const Color c = picture.at(x, y);
      count += c.r > 90 && 2 * c.b < c.r && 4 * c.g > 2 * c.r && 4 * c.g < 4 * c.r;
    }
  return count;
}

const std::string kBare = " --show no-forces,no-cones,no-hips,no-proxies";

TEST(PercroPicture, ShowsArmsWhereTheRigHasThem) {
  EXPECT_GT(yellowIn(pictureOf(runWith("pinch_cube_percro.xml"), "arms.png", kBare)), 60);
  EXPECT_EQ(yellowIn(pictureOf(runWith("pinch_cube.xml"), "scripted.png", kBare)), 0);
  EXPECT_EQ(yellowIn(pictureOf(runWith("pinch_cube_percro.xml"), "hidden.png", kBare + ",no-devices")), 0);
}

// A recording has what the figure needs, and nothing else of the run is in it: the arms of a replay are those of the
// run. The picture that is due at 3 s shows the next tick of the view, 3.010 s; a replay a millisecond beside it differs in
// 20 pixels.
TEST(PercroPicture, AReplayDrawsTheArmsOfItsRun) {
  const std::string record = scratch("arms.h5");
  const std::string run = pictureOf(runWith("pinch_cube_percro.xml") + " --record " + record, "run.png",
                                    " --screenshot-at 3 --show compliance");
  const std::string replay = "replay " + record;
  EXPECT_EQ(differentPixels(run, pictureOf(replay, "replay.png", " --screenshot-at 3.01 --show compliance")), 0);
  EXPECT_GT(differentPixels(run, pictureOf(replay, "early.png", " --screenshot-at 0.5 --show compliance")), 500);
}

// Its page holds the pose of each part at each keyframe: the inner tube ends at the recorded fingertip.
TEST(PercroPicture, ThePageOfARecordingHasTheArms) {
  const std::string record = scratch("page.h5"), page = scratch("page.html");
  ASSERT_EQ(presa(runWith("pinch_cube_percro.xml") + " --for 3 --record " + record).status, 0);
  const Outcome written = presa("replay " + record + " --page " + page);
  ASSERT_EQ(written.status, 0) << written.err;
  const Recording recording = recordPlugin().read(record);
  const RecordedSamples samples = recordPlugin().samples(record);
  Diagnostics diagnostics;
  const Loaded loaded =
      loadWithoutDevices({recording.scene_xml, recording.scene_file, recording.rig_xml}, {}, diagnostics);
  ASSERT_TRUE(loaded.world) << diagnostics.text();
  const replay_page::PageFigures figures = replay_page::figuresOf(loaded.world->rig, samples);
  ASSERT_EQ(figures.size(), 2u);
  EXPECT_EQ(replay_page::partCount(figures), 2u * percro::kDrawnParts);
  const std::vector<std::size_t> rows{0, 1000, 2000, samples.time.size() - 1};
  for (const replay_page::PageFigure& figure : figures) {
    const auto motion = replay_page::motionOf(figure, samples, rows);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const auto at = [&](const char* column) { return samples.fingers[figure.finger].values(column)[rows[k]]; };
      const Vec3 p_WH(at("p_WH_x"), at("p_WH_y"), at("p_WH_z"));
      EXPECT_LT((motion[percro::kInnerTube][k].p - p_WH).norm(), 1e-12);
      EXPECT_LT((motion[percro::kBase][k].p - motion[percro::kBase][0].p).norm(), 1e-15);
    }
  }
  std::ifstream in(page);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  EXPECT_NE(text.find("\"name\":\"inner tube\""), std::string::npos);
}

}  // namespace
}  // namespace presa::test
