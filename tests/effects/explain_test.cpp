#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/presa/explain/callgrind_file.h"
#include "apps/presa/explain/instruction_counts.h"
#include "apps/presa/explain/module_times.h"
#include "framework/core/schedule/executor.h"
#include "framework/session/session.h"
#include "tests/apps/presa/support.h"
#include "tests/effects/instructions.h"

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

// The list is the truth: what the scene names is in it, what it does not name is left out with the reason.
TEST(Explain, ListsTheStagesThatRunAndTheReasonsOfThoseThatDoNot) {
  const std::string cube = source("config/scenes/cube.xml");
  const json full = explain(cube);
  EXPECT_TRUE(hasStage(full, "friction: two-state cone"));
  EXPECT_TRUE(hasStage(full, "surface damping"));
  EXPECT_TRUE(hasStage(full, "interpolate the Object State"));
  EXPECT_FALSE(hasStage(full, "shading"));
  EXPECT_NE(whyLeftOut(full, "force shading").find("smooth"), std::string::npos);
  EXPECT_EQ(whyLeftOut(full, "friction"), "not left out");
  EXPECT_NE(whyLeftOut(full, "changing friction").find("<changed>"), std::string::npos);
  EXPECT_TRUE(hasStage(explain(cube + " --set material/rubber/friction/changed/static=0.2"),
                       "another after the surfaces have changed"));

  const json bare = explain(cube +
                            " --set material/rubber/friction/static=0 --set material/rubber/friction/dynamic=0"
                            " --set material/wood/friction/static=0 --set material/wood/friction/dynamic=0"
                            " --set material/rubber/damping=0 --set material/wood/damping=0 --set haptics/pose=hold");
  EXPECT_FALSE(hasStage(bare, "friction: two-state cone"));
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

// A file by hand: f costs 10 itself and calls g twice for 30; names come whole once, then by number.
TEST(CallgrindFile, SumsWhatAFunctionAndItsCalleesCost) {
  std::istringstream file(
      "# callgrind format\nversion: 1\nevents: Ir\n\nob=(1) /bin/x\nfl=(1) x.cpp\nfn=(1) f(int)\n12 4\n+1 6\n"
      "cfn=(2) g::h\ncalls=2 40\n* 30\n\nfn=(2)\n40 25\n-3 5\ncfn=(3) g::h(int)::{lambda()#1}::operator()() const\n"
      "calls=1 9\n* 0\ntotals: 40\n");
  const auto costs = readCallgrind(file);
  EXPECT_EQ(costs.at("f(int)").instructions, 40u);
  EXPECT_EQ(costs.at("g::h").instructions, 30u);
  EXPECT_EQ(costs.at("g::h").calls, 2u);
  EXPECT_EQ(costOf(costs, "g::h")->calls, 2u);  // without its lambda
  EXPECT_FALSE(costOf(costs, "g"));
  std::istringstream nonsense("hello");
  EXPECT_THROW(readCallgrind(nonsense), std::runtime_error);
}

double sumOf(const json& run, const char* module, const char* key) {
  double sum = 0;
  for (const json& stage : run["stages"]) {
    if (stage["module"] == module) sum += stage[key].get<double>();
  }
  return sum;
}

// Every module and every stage has a time, recording and view too; with valgrind its instructions, and the stages of a tick
// make up their module's.
TEST(ExplainCost, AddsWhatEachPartCosts) {
  const json run = explain(source("config/scenes/pinch_and_lift.xml") + " --cost --record --view offscreen");
  ASSERT_TRUE(run.contains("cost"));
  for (const char* list : {"modules", "stages"}) {
    for (const json& part : run[list]) {
      ASSERT_TRUE(part["median_ns"].is_number()) << part;
      EXPECT_GT(part["ticks"], 0) << part;
      EXPECT_GE(part["p999_ns"], part["median_ns"]) << part;
    }
  }
  if (!test::valgrindWorks()) GTEST_SKIP() << "valgrind is not installed: instructions cannot be counted";
  for (const json& module : run["modules"]) {
    const auto name = module["name"].get<std::string>();
    if (name == "view_osg") continue;  // the run under valgrind draws nothing
    const double whole = module["instructions_per_tick"], parts = sumOf(run, name.c_str(), "instructions_per_tick");
    EXPECT_LE(parts, whole * (1 + 1e-9)) << name;
    EXPECT_GT(parts, 0.7 * whole) << name;  // the rest: calls, loops, what no stage owns
  }
}

// A run that is timed stage by stage is the same run: its states have the hash of one that is not.
TEST(ExplainCost, MeasuringChangesNoBit) {
  const auto sessionOf = [](RunControl& control, RateTable& rates) {
    Diagnostics diagnostics;
    const Loaded loaded = loadWorld({source("config/scenes/pinch_and_lift.xml"), "", {}}, {}, diagnostics);
    rates = RateTable(loaded.world->scene.rates);
    return std::make_unique<Session>(loaded.world, loaded.plan, control, Session::Options{});
  };
  constexpr double kLength = 2.5;  // [s] the amphora is in the air
  RunControl control;
  RateTable rates{Rates{}};
  const auto measured = sessionOf(control, rates);
  EXPECT_GT(measureModuleTimes(measured->graph(), rates, kLength).at("haptics_proxy").stages.size(), 4u);
  const auto plain = sessionOf(control, rates);
  LockstepExecutor(plain->graph(), rates, control).run(kLength);
  EXPECT_EQ(measured->monitor().hash(), plain->monitor().hash());
}

}  // namespace
}  // namespace presa
