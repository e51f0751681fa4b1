// `presa cost --apply`: the better setting as a scene, where there is one.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "apps/common/file_text.h"
#include "apps/studies/cost/apply.h"
#include "tests/apps/support/support.h"

namespace presa::cost {
namespace {

using test::presa;
using test::scratch;

/// A free body falls; its error is of first order in the step of the dynamics.
std::string fallingScene(const std::string& name, const std::string& haptic = "1000") {
  const std::string file = scratch(name);
  std::ofstream(file) << std::string(R"(<?xml version="1.0" encoding="UTF-8"?>
<!-- dropped from the table -->
<scene version="1.0" name="fall">
  <world gravity="0 0 -9.81"/>
  <rates haptic=")") + haptic +
                             R"("   dynamics="200"/>  <!-- as in the thesis -->
  <materials><material name="m" stiffness="1000"/></materials>
  <body name="body"><physics mass="0.2"><sphere radius="0.05"/></physics></body>
</scene>
)";
  return file;
}

// Without a finger the haptic rate buys nothing: a tenth of it is as accurate and cheaper. A coarser step of the
// dynamics is cheaper but less accurate: that beats nothing.
TEST(Apply, RunsFromTheCommandLine) {
  const std::string scene = fallingScene("fall.xml", "20000"), out = scratch("fall"), better = scratch("better.xml");
  const std::string study = "cost " + scene + " --for 2 --metric position --out " + out + " --apply " + better;
  auto outcome = presa(study + " --knob dynamics_rate=100,200");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("The default is on the front: " + better + " is not written."), std::string::npos)
      << outcome.out;
  EXPECT_FALSE(std::filesystem::exists(better));
  outcome = presa(study + " --knob haptic_rate=1000,20000");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("The default is beaten by haptic_rate 1000."), std::string::npos) << outcome.out;
  EXPECT_EQ(contentsOf(better), contentsOf(fallingScene("fall_coarse.xml", "1000")));
  EXPECT_NE(contentsOf(out + "/report.html").find("The default is beaten by haptic_rate 1000"), std::string::npos);
}

/// A result in which setting 1 is better than the default.
Result beatenResult(const std::string& scene, const std::vector<std::string>& sets) {
  Result result;
  result.study.inputs.scene = scene;
  result.metrics = {"position"};
  for (const double error : {1.0, 0.1}) {
    Outcome& outcome = result.outcomes.emplace_back();
    outcome.setting.name = error == 1 ? "default" : "finer";
    if (error < 1) outcome.setting.sets = sets;
    outcome.error["position"] = error;
    Timing timing;
    timing.per_second = 0.01;
    outcome.timings.push_back(timing);
  }
  return result;
}

TEST(Apply, ChangesOnlyWhatTheBetterSettingSets) {
  const std::string scene = fallingScene("fall_kept.xml"), better = scratch("fall_better.xml");
  const std::string said = applyBetter(beatenResult(scene, {"rates/dynamics=500", "dynamics/rotation=none"}), better);
  EXPECT_EQ(said, better + " is " + scene + " with --set rates/dynamics=500 --set dynamics/rotation=none.");
  std::string expected = contentsOf(scene);
  expected.replace(expected.find("dynamics=\"200\""), 14, "dynamics=\"500\"");
  expected.insert(expected.find("\n  <world"), "\n  <dynamics rotation=\"none\"/>");
  EXPECT_EQ(contentsOf(better), expected);
}

TEST(Apply, WritesNothingWhereNothingBeatsTheDefault) {
  const std::string scene = fallingScene("fall_best.xml"), better = scratch("not_written.xml");
  Result result = beatenResult(scene, {"rates/dynamics=500"});
  result.outcomes[1].error["position"] = 2;
  EXPECT_EQ(applyBetter(result, better), "The default is on the front: " + better + " is not written.");
  EXPECT_FALSE(std::filesystem::exists(better));
}

TEST(Apply, RefusesABadFileBeforeAnyRun) {
  const std::string scene = fallingScene("fall_refused.xml"), out = scratch("never_run");
  for (const std::string& file : {scratch("no_such_folder") + "/better.xml", scene, std::string("/")}) {
    const auto outcome =
        presa("cost " + scene + " --for 0.3 --knob dynamics_rate=100,200 --out " + out + " --apply " + file);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find("error[E809]"), std::string::npos) << outcome.err;
  }
  EXPECT_FALSE(std::filesystem::exists(out));
  EXPECT_NE(presa("cost --help").out.find("--apply"), std::string::npos);
}

}  // namespace
}  // namespace presa::cost
