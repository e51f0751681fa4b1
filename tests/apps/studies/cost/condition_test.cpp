// Knobs that are no values of the scene: latency and jitter.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "apps/common/file_text.h"
#include "apps/studies/cost/condition_factor.h"
#include "apps/studies/cost/factors.h"
#include "tests/apps/support/support.h"

namespace presa::cost {
namespace {

using Sets = std::vector<std::string>;

const std::string kCube = test::source("config/scenes/cube.xml");

Setting with(const std::string& set) {
  Setting setting;
  setting.sets = {set};
  return setting;
}

std::string errorsOf(const std::string& set) {
  Sets sets{set};
  Diagnostics diagnostics;
  takeConditions(sets, diagnostics);
  return diagnostics.text();
}

TEST(Conditions, AreTakenOutOfTheSets) {
  Sets sets{"rates/dynamics=500", "run/latency=0.01", "run/haptic_jitter=0.1", "run/dynamics_jitter=0.2:4"};
  Diagnostics diagnostics;
  const Conditions taken = takeConditions(sets, diagnostics);
  EXPECT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  EXPECT_EQ(sets, Sets{"rates/dynamics=500"});
  EXPECT_EQ(taken, (Conditions{.latency = 0.01, .haptic = {0.1, 5}, .collision = {}, .dynamics = {0.2, 4}}));
}

TEST(Conditions, ThatDelayNothingAreNone) {
  for (const char* set : {"run/latency=0", "run/haptic_jitter=0", "run/haptic_jitter=0:3", "run/dynamics_jitter=0.5:1"})
    EXPECT_FALSE(hasConditions(with(set))) << set;
  for (const char* set : {"run/latency=0.001", "run/haptic_jitter=0.1", "run/collision_jitter=1:100"})
    EXPECT_TRUE(hasConditions(with(set))) << set;
}

TEST(Conditions, AreRefusedOutOfRange) {
  for (const char* set :
       {"run/latency=-1", "run/latency=2", "run/latency=10ms", "run/latency=", "run/haptic_jitter=1.1",
        "run/haptic_jitter=0.1:", "run/haptic_jitter=0.1:0", "run/collision_jitter=0.1:101", "run/dynamics_jitter=nan"})
    EXPECT_NE(errorsOf(set).find("error[E802]"), std::string::npos) << set;
  EXPECT_EQ(errorsOf("run/latncy=1"),
            "run/latncy=1: error[E801]: there is no condition 'run/latncy' (did you mean 'run/latency'?)\n"
            "  help: conditions of a run: run/latency, run/haptic_jitter, run/collision_jitter, run/dynamics_jitter\n");
}

TEST(Conditions, AreNoValuesForAllSettings) {
  const auto outcome = test::presa("cost " + kCube + " --set run/latency=0.01 --out " + test::scratch("never"));
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.err,
            "--set: error[E802]: 'run/latency=0.01' is a condition of the run, and no value of the scene\n"
            "  help: conditions are knobs, beside a run without: --knob latency=0,0.01\n");
}

// The hash decides which stored run is taken again.
TEST(Conditions, CountInTheHashOfASetting) {
  Diagnostics diagnostics;
  const auto hash = [&](const Sets& sets) { return checkedScene({kCube, "", {}}, sets, "", diagnostics); };
  const std::uint64_t alone = hash({});
  EXPECT_EQ(alone, hash({"run/latency=0"}));
  EXPECT_NE(alone, hash({"run/latency=0.001"}));
  EXPECT_NE(hash({"run/haptic_jitter=0.1"}), hash({"run/haptic_jitter=0.1:4"}));
  EXPECT_NE(hash({"run/haptic_jitter=0.1"}), hash({"run/dynamics_jitter=0.1:5"}));
  EXPECT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
}

// A delayed force gives the hands energy, the more the later it comes: at least 1.5 times as much for twice the delay.
// No delay is a choice: the default is not beaten.
TEST(Conditions, AStudyComparesDelaysWithARunWithoutAny) {
  const std::string out = test::scratch("delays");
  const auto outcome =
      test::presa("cost " + kCube + " --for 2 --quick --metric force_held --metric energy_created --out " + out +
                  " --knob latency=0,0.001,0.002,0.004");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("The default has no rival here"), std::string::npos) << outcome.out;
  const auto report = nlohmann::json::parse(contentsOf(out + "/cost.json"));
  ASSERT_EQ(report["settings"].size(), 4u);
  EXPECT_EQ(report["settings"][0]["name"], "default");
  double force = 0, energy = 0;
  for (const auto& setting : report["settings"]) {
    EXPECT_GT(setting["error"]["force_held"], force) << setting["name"];
    EXPECT_GT(setting["error"]["energy_created"], 1.5 * energy) << setting["name"];
    force = setting["error"]["force_held"];
    energy = setting["error"]["energy_created"];
  }
}

}  // namespace
}  // namespace presa::cost
