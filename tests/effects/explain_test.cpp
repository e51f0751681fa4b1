#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/common/scratch_folder.h"
#include "apps/presa/explain/module_times.h"
#include "framework/core/schedule/executor.h"
#include "framework/session/session.h"
#include "tests/apps/support/support.h"

namespace presa {
namespace {

using nlohmann::json;
using test::source;

json explain(const std::string& arguments) {
  const auto outcome = test::presa("explain " + arguments + " --format json");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return outcome.status == 0 ? json::parse(outcome.out) : json();
}

bool hasStage(const json& run, const std::string& words) {
  return std::any_of(run["stages"].begin(), run["stages"].end(), [&](const json& stage) {
    return stage["stage"].get<std::string>().find(words) != std::string::npos;
  });
}
std::string whyLeftOut(const json& run, const std::string& what) {
  for (const json& left_out : run["left_out"]) {
    if (left_out["what"] == what) return left_out["why"];
  }
  return "not left out";
}

// The list is true: stages that the scene needs are in it, the others are left out with the reason.
TEST(Explain, ListsTheStagesThatRunAndTheReasonsOfThoseThatDoNot) {
  const std::string cube = source("config/scenes/cube.xml");
  const json full = explain(cube);
  EXPECT_TRUE(hasStage(full, "friction: friction_cone"));
  EXPECT_TRUE(hasStage(full, "surface damping"));
  EXPECT_TRUE(hasStage(full, "interpolate the Object State"));
  EXPECT_FALSE(hasStage(full, "shading"));
  EXPECT_NE(whyLeftOut(full, "shading").find("smooth"), std::string::npos);
  EXPECT_EQ(whyLeftOut(full, "friction"), "not left out");
  EXPECT_NE(whyLeftOut(full, "changing friction").find("<changed>"), std::string::npos);
  EXPECT_TRUE(hasStage(explain(cube + " --set material/rubber/friction/changed/static=0.2"),
                       "with other coefficients after the surface change"));

  const json bare = explain(cube +
                            " --set material/rubber/friction/static=0 --set material/rubber/friction/dynamic=0"
                            " --set material/wood/friction/static=0 --set material/wood/friction/dynamic=0"
                            " --set material/rubber/damping=0 --set material/wood/damping=0 --set haptics/pose=hold");
  EXPECT_FALSE(hasStage(bare, "friction: friction_cone"));
  EXPECT_FALSE(hasStage(bare, "surface damping"));
  EXPECT_FALSE(hasStage(bare, "interpolate the Object State"));
  EXPECT_NE(whyLeftOut(bare, "friction").find("no touchable material"), std::string::npos);

  EXPECT_TRUE(hasStage(explain(cube + " --set haptics/renderer=penalty"), "penalty"));
}

TEST(Explain, NamesThreadsModulesAndLibrariesWithReasons) {
  const json run = explain(source("config/scenes/pinch_and_lift.xml"));
  ASSERT_EQ(run["threads"].size(), 3u);
  for (const json& thread : run["threads"]) {
    EXPECT_NEAR(thread["rate_hz"].get<double>() * thread["period_s"].get<double>(), 1, 1e-12);
  }
  for (const json& module : run["modules"]) EXPECT_FALSE(module["reason"].get<std::string>().empty());
  const auto needed_by = [&](const std::string& start) -> std::string {
    for (const json& library : run["libraries"]) {
      if (library["name"].get<std::string>().starts_with(start)) return library["needed_by"];
    }
    return "nobody";
  };
  EXPECT_EQ(needed_by("presa_collision_fcl.so"), "the scene");
  EXPECT_EQ(needed_by("libfcl.so"), "the scene");
  EXPECT_EQ(needed_by("libc.so"), "the program");
  EXPECT_EQ(needed_by("libosg"), "nobody");
}

// ---- cost ----------------------------------------------------------------------------------------------------------

// Every module, recording and view included, has a time and its share of the period of its thread.
TEST(ExplainCost, AddsWhatEachModuleCosts) {
  const json run = explain(source("config/scenes/pinch_and_lift.xml") + " --cost --record --view offscreen");
  ASSERT_TRUE(run.contains("cost"));
  for (const json& module : run["modules"]) {
    ASSERT_TRUE(module["median_ns"].is_number()) << module;
    EXPECT_GT(module["ticks"], 0) << module;
    EXPECT_GE(module["p999_ns"], module["median_ns"]) << module;
    const double rate = std::find_if(run["threads"].begin(), run["threads"].end(), [&](const json& thread) {
                          return thread["name"] == module["group"];
                        })->at("rate_hz");
    EXPECT_NEAR(module["share_of_period"], module["median_ns"].get<double>() * 1e-9 * rate, 1e-9) << module;
  }
}

// One row of figures per module, none per stage.
TEST(ExplainCost, PrintsATableOfModules) {
  const auto outcome = test::presa("explain " + source("config/scenes/cube.xml") + " --cost");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  std::istringstream lines(outcome.out);
  std::map<std::string, bool> measured;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string first;
    words >> first;
    measured[first] = measured[first] || line.ends_with(" %");
  }
  for (const char* module : {"device_input", "haptics_proxy", "device_output", "monitor", "dynamics_ode"})
    EXPECT_TRUE(measured[module]) << module << " in\n" << outcome.out;
  EXPECT_FALSE(measured["1."]);
}

// Timing every module does not change a run: the state hash is the same.
TEST(ExplainCost, MeasuringChangesNoBit) {
  const auto sessionOf = [](RunControl& control, RateTable& rates) {
    Diagnostics diagnostics;
    Loaded loaded = loadWorld({source("config/scenes/pinch_and_lift.xml"), "", {}}, {}, diagnostics);
    rates = RateTable(loaded.world->scene.rates);
    return std::make_unique<Session>(std::move(loaded), control, Session::Options{});
  };
  constexpr double kLength = 2.5;  // [s] the amphora is lifted by then
  RunControl control;
  RateTable rates{Rates{}};
  const auto measured = sessionOf(control, rates);
  EXPECT_EQ(measureModuleTimes(measured->graph(), rates, kLength).at("haptics_proxy").ticks, 2500u);
  const auto plain = sessionOf(control, rates);
  LockstepExecutor(plain->graph(), rates, control).run(kLength);
  EXPECT_EQ(measured->monitor().hash(), plain->monitor().hash());
}

TEST(Explain, SaysInWhichFramesADeviceStands) {
  const json walking = explain(source("config/scenes/cube.xml") + " --rig " + source("config/rigs/walking_pair.xml"));
  EXPECT_EQ(walking["devices"][0]["frames"], json({"desk", "user"}));
  EXPECT_TRUE(explain(source("config/scenes/cube.xml"))["devices"][0]["frames"].empty());
}

// What a user may do with frames, and what a view draws of bodies with textures: in text and JSON, only where they are.
TEST(Explain, OnlyRigsAndScenesWithThemTellOfMovedFramesAndModels) {
  const std::string cube = source("config/scenes/cube.xml"),
                    clutched = cube + " --rig " + source("config/rigs/clutch_pair.xml");
  const json run = explain(clutched);
  ASSERT_EQ(run["frames"].size(), 2u) << "the head is fixed";
  EXPECT_EQ(
      run["frames"][0]["what"],
      "in world; walks at up to 0.3 m/s and turns at up to 60 deg/s, by the window's keys; rests while a finger in it "
      "feels a force");
  EXPECT_EQ(run["frames"][1]["what"],
            "in user; clutch by button 1 or the window's key; scale 0.5 to 2, finer by button 2 or the window's key, "
            "coarser by button 3 or the window's key; rests while a finger in it feels a force");
  EXPECT_NE(test::presa("explain " + clutched).out.find("\nFrames that a user moves\n  user"), std::string::npos);
  const std::string drum = source("config/scenes/photographed.xml");
  const json drawn = explain(drum);
  ASSERT_EQ(drawn["models"].size(), 1u);
  EXPECT_EQ(drawn["models"][0]["body"], "drum");
  const std::string what = drawn["models"][0]["what"];
  EXPECT_TRUE(what.starts_with("drum.glb, ")) << what;
  EXPECT_NE(what.find("textures "), std::string::npos) << what;
  EXPECT_NE(test::presa("explain " + drum).out.find("\nBodies drawn as models\n  drum "), std::string::npos);
  const json plain = explain(cube);
  EXPECT_FALSE(plain.contains("frames"));
  EXPECT_FALSE(plain.contains("models"));
}

// A driver that sees the world moves in it. Its samples would be taken for those of the frame.
TEST(Explain, RefusesADriverThatSeesTheWorldInAFrame) {
  const ScratchFolder folder;
  std::ofstream(folder.file("rig.xml")) << R"(<rig version="1.0" name="desk"><frame name="desk" pos="1 0 0"/>
<device role="thumb" driver="clumsy_hand" in="desk"/><device role="index" driver="clumsy_hand"/></rig>)";
  const auto outcome =
      test::presa("run " + source("config/scenes/cube.xml") + " --lockstep --for 1 --rig " + folder.file("rig.xml"));
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("rig.xml:2:1: error[E428]: role 'thumb': driver 'clumsy_hand' sees the world"),
            std::string::npos)
      << outcome.err;
}

}  // namespace
}  // namespace presa
