// Each scene of the gallery: what it says of itself, that it holds what it grasps, and that mouse and keys can take over.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "apps/common/file_text.h"
#include "apps/presa/gallery/entries.h"
#include "apps/presa/gallery/groups.h"
#include "apps/presa/gallery/mouse_rig.h"
#include "framework/scene/load.h"
#include "framework/session/run.h"
#include "tests/apps/support/support.h"

namespace presa {
namespace {

using gallery::Entry;

const std::vector<Entry>& all() {
  static const std::vector<Entry> entries = [] {
    Diagnostics diagnostics;
    std::vector<Entry> read = gallery::entries(diagnostics);
    if (diagnostics.hasErrors()) throw InputError(diagnostics);
    return read;
  }();
  return entries;
}

class GalleryScene : public testing::TestWithParam<Entry> {};

// A scene is read in a minute: 60 lines, one sentence of one line, one heading.
TEST_P(GalleryScene, IsShortAndSaysWhatItShows) {
  const Entry& entry = GetParam();
  const std::string text = contentsOf(entry.file);
  EXPECT_LE(std::ranges::count(text, '\n'), 60);
  EXPECT_GE(entry.sentence.size(), 20U);
  EXPECT_LE(entry.sentence.size(), 105U);
  EXPECT_FALSE(entry.sentence.ends_with('.'));
  EXPECT_NE(std::ranges::find(gallery::groups(), entry.group, &gallery::Group::name), gallery::groups().end())
      << entry.group;
  EXPECT_NE(entry.picture, "") << "./dev pictures scenes/" << entry.name;
}

/// A place for the pointer's states, so that the graph is that of a window; the mouse lies still.
class StillMouse final : public Module {
 public:
  StillMouse() : Module("mouse", RateGroup::kView) {}
  void step(const Tick&) noexcept override {}

 private:
  Out<PointerState> pointer_{*this, kPointerPort};
};

Scene sceneOf(const Entry& entry) {
  Diagnostics diagnostics;
  return loadScene(entry.file, {}, diagnostics);
}

/// Scenes that somebody touches.
std::vector<Entry> touched() {
  std::vector<Entry> entries = all();
  std::erase_if(entries, [](const Entry& entry) { return sceneOf(entry).devices.empty(); });
  return entries;
}

class GalleryMouse : public testing::TestWithParam<Entry> {};

// Everybody can try every scene: mouse and keys take its first hand, and nothing fails in half a second.
TEST_P(GalleryMouse, TakesTheFirstHand) {
  Diagnostics diagnostics;
  const Scene scene = sceneOf(GetParam());
  const std::string rig = test::scratch(GetParam().name + "_mouse.xml");
  std::ofstream(rig) << gallery::mouseRig(scene, loadRig(scene.default_rig, diagnostics));
  RunOptions options;
  options.duration = 0.5;
  options.bound_stiffness = true;
  Loaded loaded = loadWorld({GetParam().file, rig, {}}, options, diagnostics);
  ASSERT_EQ(diagnostics.errorCount(), 0U) << diagnostics.text();
  EXPECT_EQ(loaded.plan.devices.size(), scene.devices.size());
  EXPECT_EQ(loaded.plan.devices.front().driver, "pointer");
  RunControl control;
  Session::Options session;
  session.open_devices = false;  // avoids the check for a window
  session.more.push_back(std::make_unique<StillMouse>());
  presa::Run run(std::move(loaded), control, std::move(session));
  run.execute();
  for (const FingerSummary& finger : run.monitor().fingers()) EXPECT_LE(finger.max_commanded_force, 12.0);
}

INSTANTIATE_TEST_SUITE_P(Shipped, GalleryScene, testing::ValuesIn(all()),
                         [](const auto& entry) { return entry.param.name; });
INSTANTIATE_TEST_SUITE_P(Shipped, GalleryMouse, testing::ValuesIn(touched()),
                         [](const auto& entry) { return entry.param.name; });

/// A scripted grasp: what it lifts, and how far its hand moves [m]. The load bends the hand's spring, which an integral
/// takes back slowly: of the 7.4 mm under half of the can (0.35 kg, 1 / 300 + 1 / 1000 m/N) a quarter is left at the end of
/// the hold, and less under all others.
struct Grasp {
  const char *scene, *object;
  double lift;
};

class GalleryGrasp : public testing::TestWithParam<Grasp> {};

// What a grasp of the gallery lifts is lifted, held, and not dropped.
TEST_P(GalleryGrasp, Holds) {
  const auto run = test::runScene(std::string("config/scenes/") + GetParam().scene + ".xml", {}, {}, 0);
  EXPECT_TRUE(run->result().faults.empty());
  bool found = false;
  for (const RunResult::Object& object : run->result().objects) {
    if (object.name != GetParam().object) continue;
    found = true;
    EXPECT_TRUE(object.summary.grasped);
    EXPECT_FALSE(object.summary.dropped);
    EXPECT_NEAR(object.summary.highest.z() - object.summary.start.z(), GetParam().lift, 0.002);
    EXPECT_NEAR((object.summary.final - object.summary.start).norm(), 0, 0.001) << "it is put back";
  }
  EXPECT_TRUE(found);
}

INSTANTIATE_TEST_SUITE_P(Of, GalleryGrasp,
                         testing::Values(Grasp{"sphere", "ball", 0.08}, Grasp{"cylinder", "can", 0.08},
                                         Grasp{"tilted", "block", 0.08}, Grasp{"tripod", "bottle", 0.08},
                                         Grasp{"two_hands", "bar", 0.08}, Grasp{"hand_over", "baton", 0.06},
                                         Grasp{"tower", "block_6", 0.041}, Grasp{"size_weight", "large", 0.06},
                                         Grasp{"size_weight", "small", 0.06}),
                         [](const auto& grasp) { return std::string(grasp.param.scene) + "_" + grasp.param.object; });

// Forty and more, and each group that has a title has a scene.
TEST(Gallery, HasAtLeastFortyScenesAndNoEmptyGroup) {
  EXPECT_GE(all().size(), 40U);
  for (const gallery::Group& group : gallery::groups())
    EXPECT_NE(std::ranges::find(all(), group.name, &Entry::group), all().end()) << group.name;
}

/// The largest force along the normal that the finger of a scene felt [N].
double pressedWith(const std::string& scene) {
  const auto run = test::runScene("config/scenes/" + scene + ".xml", {}, {}, 0);
  return run->result().contact_points.front().summary.max_normal_force;
}

// 3 mm into 1 N/mm are 3 N; the hand, on its spring, may miss a few hundredths of a millimetre.
TEST(Gallery, PlaneAndPlateAnswerWithStiffnessTimesDepth) {
  EXPECT_NEAR(pressedWith("plane"), 3, 0.05);
  EXPECT_NEAR(pressedWith("stiffness_pair"), 3, 0.1);
}

// The finger sticks for most of the time and leaps several times: a steady slide would slip for most of it, once.
TEST(Gallery, StickSlipSticksAndSlips) {
  const auto run = test::runScene("config/scenes/stick_slip.xml", {}, {}, 0);
  const FingerSummary& finger = run->result().contact_points.front().summary;
  EXPECT_GE(finger.slip_onsets, 5U);
  EXPECT_GT(finger.seconds[1], 5 * finger.seconds[2]);
}

// Only the brick that is pushed moves.
TEST(Gallery, AWallLosesOneBrick) {
  const auto run = test::runScene("config/scenes/wall.xml", {}, {}, 0);
  for (const RunResult::Object& object : run->result().objects) {
    const double moved = (object.summary.final - object.summary.start).norm();
    if (object.name == "brick_9") {
      EXPECT_NEAR(moved, 0.02, 0.002);
    } else {
      EXPECT_LT(moved, 0.001) << object.name;
    }
  }
}

}  // namespace
}  // namespace presa
