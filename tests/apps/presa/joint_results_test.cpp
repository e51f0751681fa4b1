// Joints in summary, report, recordings, viewer, explain and check, against motions with a closed form.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "apps/common/file_text.h"
#include "apps/common/joint_log.h"
#include "apps/presa/replay_page/signals.h"
#include "framework/record/record_plugin.h"
#include "framework/session/load_world.h"
#include "tests/apps/support/support.h"
#include "tests/support/alloc_lock_guard.h"
#include "tests/support/png_picture.h"

namespace presa {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

constexpr double kStep = 1.0 / 200, kRunFor = 2, kSpeed = 7, kFall = 0.05, kG = 9.81;
constexpr double kDegree = std::numbers::pi / 180;

/// A wheel that a motor turns at kSpeed, a weight that falls by kFall to its stop, and a lamp that is glued on.
std::string jointMachine() {
  const auto body = [](const std::string& name, const std::string& pos, const std::string& size) {
    return "<body name=\"" + name + "\" pos=\"" + pos + "\"><haptic><box size=\"" + size +
           "\"/></haptic><physics mass=\"0.2\"><box size=\"" + size + "\"/></physics></body>";
  };
  const std::string file = test::scratch("machine.xml");
  std::ofstream(file)
      << "<scene version=\"1.0\" name=\"machine\"><world gravity=\"0 0 -9.81\"/>"
         "<materials><material name=\"m\" stiffness=\"1000\"/></materials>"
      << body("wheel", "0 0 0.2", "0.08 0.08 0.02") << body("weight", "0.2 0 0.2", "0.04 0.04 0.04")
      << body("lamp", "-0.2 0 0.2", "0.02 0.02 0.02")
      << "<joint name=\"axle\" type=\"hinge\" body=\"wheel\"><axis dir=\"0 0 1\" speed=\"7\" max_force=\"5\"/></joint>"
         "<joint name=\"mast\" type=\"slider\" body=\"weight\"><axis dir=\"0 0 1\" lower=\"-0.05\" "
         "upper=\"0.1\"/></joint>"
         "<joint name=\"glue\" type=\"fixed\" body=\"lamp\"/></scene>";
  return file;
}

std::string runMachine(const std::string& more) {
  const test::Outcome outcome =
      test::presa("run " + jointMachine() + " --lockstep --for 2 --view none --quiet " + more);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return outcome.out;
}

// A joint carries the knob of the door and turns it: neither its weight nor its turn in the fingers says anything.
TEST(JointResults, GraspOfAJoinedObjectHasNoSlipLimitAndNoTurn) {
  const std::string file = test::scratch("door.json");
  const test::Outcome outcome =
      test::presa("run " + test::source("config/scenes/door.xml") + " --lockstep --view none --summary " + file);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json grasp = json::parse(contentsOf(file)).at("grasp");
  EXPECT_EQ(grasp.at("object"), "knob");
  EXPECT_TRUE(grasp.at("slip_limit_N").is_null());
  EXPECT_TRUE(grasp.at("turn").is_null());
  EXPECT_TRUE(grasp.at("fingers").at(0).at("weight_share").is_null());
  EXPECT_THAT(outcome.out, Not(HasSubstr("turned")));
  EXPECT_THAT(outcome.out, Not(HasSubstr("weight")));
}

// The motor is strong enough for its speed in the first step, and the speed of a step is that at its end: the last angle
// is known to one step. The fall takes sqrt(2 h / g), to one step.
TEST(JointResults, SummaryHasRangesAndTimesAtStops) {
  const std::string file = test::scratch("joints.json");
  runMachine("--summary " + file);
  const json joints = json::parse(contentsOf(file))["joints"];
  ASSERT_EQ(joints.size(), 3u);
  EXPECT_EQ(joints[0]["name"], "axle");
  EXPECT_EQ(joints[0]["type"], "hinge");
  const json axle = joints[0]["positions"][0], mast = joints[1]["positions"][0];
  EXPECT_EQ(axle["unit"], "deg");
  EXPECT_NEAR(axle["end"].get<double>() * kDegree, kSpeed * kRunFor, kSpeed * kStep);
  EXPECT_EQ(axle["max"], axle["end"]);
  EXPECT_NEAR(axle["start"].get<double>(), 0, 1e-9);
  EXPECT_TRUE(axle["at_lower_s"].is_null());
  EXPECT_EQ(mast["unit"], "m");
  EXPECT_NEAR(mast["min"].get<double>(), -kFall, kAtStop);
  EXPECT_NEAR(mast["end"].get<double>(), -kFall, kAtStop);
  EXPECT_NEAR(mast["max"].get<double>(), 0, 1e-9);
  EXPECT_NEAR(mast["at_lower_s"].get<double>(), kRunFor - std::sqrt(2 * kFall / kG), 2 * kStep);
  EXPECT_EQ(mast["at_upper_s"], 0.0);
  EXPECT_TRUE(joints[2]["positions"].empty());
}

TEST(JointResults, OnlyScenesWithJointsTellOfThem) {
  const std::string summary = test::scratch("cube.json"), report = test::scratch("cube.html");
  const std::string cube = test::source("config/scenes/cube.xml");
  ASSERT_EQ(test::presa("run " + cube + " --lockstep --for 0.1 --view none --quiet --summary " + summary +
                        " --report " + report)
                .status,
            0);
  EXPECT_FALSE(json::parse(contentsOf(summary)).contains("joints"));
  EXPECT_THAT(contentsOf(report), Not(HasSubstr("<h2>Joints</h2>")));
  EXPECT_THAT(test::presa("explain " + cube).out, Not(HasSubstr("Joints")));
  EXPECT_THAT(test::presa("check " + cube).out, Not(HasSubstr("joint")));
}

TEST(JointResults, ReportHasATableAndAPlotForEachUnit) {
  const std::string file = test::scratch("joints.html");
  runMachine("--report " + file);
  const std::string page = contentsOf(file);
  EXPECT_THAT(page, HasSubstr("<h2>Joints</h2>"));
  EXPECT_THAT(page, HasSubstr("Angles of the joints over time"));
  EXPECT_THAT(page, HasSubstr("Displacements of the joints over time"));
  EXPECT_THAT(page, HasSubstr("-50.0 mm"));
}

// The log is kept on the haptic thread; it has fewer samples than the run has steps.
TEST(JointResults, LoggingNeitherAllocatesNorLocks) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  Scene scene;
  scene.bodies.resize(1);
  for (const JointType type :
       {JointType::kHinge, JointType::kUniversal, JointType::kPrismaticRotary, JointType::kBall}) {
    Joint& joint = scene.joints.emplace_back();
    joint.type = type;
    joint.axes.resize(type == JointType::kBall ? 0 : type == JointType::kHinge ? 1 : 2);
    if (type == JointType::kUniversal) joint.axes[1].dhat_B = Vec3::UnitX();
  }
  JointLog log(scene, 10, 2);
  const RealTimeGuard guard;
  for (int i = 0; i < 100; ++i) {
    const Pose X_WB{Vec3::Zero(), Quat(Eigen::AngleAxisd(0.1 * i, Vec3::UnitZ()))};
    log.add(kStep * i, kStep, [&](std::size_t) { return X_WB; });
  }
  EXPECT_EQ(guard.violations(), 0) << guard.first();
  EXPECT_EQ(log.times().size(), 10u);
  EXPECT_EQ(log.times()[1], 2 * kStep);
  EXPECT_NEAR(log.positions()[0].travel.end, 9.9, 1e-9);
}

// A recording tells the same from its poses, at every tick: turned by kSpeed t, fallen by g t^2 / 2. A step is straight,
// so between its ends the fall is off by g h^2 / 8, and a symplectic step by g t h / 2.
TEST(JointResults, RecordingGivesPositionsFromItsPoses) {
  const std::string file = test::scratch("joints.h5");
  runMachine("--overwrite --record " + file);
  const Recording recording = recordPlugin().read(file);
  const RecordedSamples samples = recordPlugin().samples(file);
  Diagnostics diagnostics;
  const Loaded loaded =
      loadWithoutDevices({recording.scene_xml, recording.scene_file, recording.rig_xml}, {}, diagnostics);
  const JointLog log = jointLogOf(samples, loaded.world->scene);
  ASSERT_EQ(log.positions().size(), 2u);
  ASSERT_EQ(log.times().size(), samples.time.size());
  for (const std::size_t row : {40u, 80u, 1000u, 1990u}) {
    const double t = samples.time[row];
    EXPECT_NEAR(log.positions()[0].samples[row], kSpeed * t, kSpeed * kStep) << t;
    const double fallen = std::min(kFall, kG * t * t / 2);
    EXPECT_NEAR(log.positions()[1].samples[row], -fallen, kG * t * kStep + kAtStop) << t;
  }
  const json panels = replay_page::signalsOf(samples, loaded.world.get(), {})["panels"];
  std::map<std::string, json> by_title;
  for (const json& panel : panels) by_title[panel["title"]] = panel;
  ASSERT_TRUE(by_title.contains("Joint angle"));
  EXPECT_EQ(by_title["Joint angle"]["unit"], "deg");
  EXPECT_EQ(by_title["Joint angle"]["curves"][0]["name"], "axle");
  ASSERT_TRUE(by_title.contains("Joint displacement"));
  EXPECT_EQ(by_title["Joint displacement"]["curves"][0]["name"], "mast");
  EXPECT_NEAR(by_title["Joint displacement"]["curves"][0]["low"]["lo"].get<double>(), -1e3 * kFall, 1e3 * kAtStop);

  const std::string page = test::scratch("joints_page.html"), picture = test::scratch("joints.png");
  const test::Outcome replayed = test::presa("replay " + file + " --verify");
  EXPECT_EQ(replayed.status, 0) << replayed.err;
  EXPECT_THAT(replayed.out, HasSubstr("joint mast: -50.0 mm at the end, -50.0 mm to 0.0 mm"));
  EXPECT_EQ(test::presa("replay " + file + " --page " + page).status, 0);
  EXPECT_THAT(contentsOf(page), HasSubstr("<h2>Joints</h2>"));
}

TEST(JointResults, ReplayDrawsJointsWhereAskedFor) {
  const std::string file = test::scratch("shown.h5"), with = test::scratch("with.png"),
                    none = test::scratch("none.png");
  runMachine("--overwrite --record " + file);
  const std::string how = "replay " + file + " --view offscreen --hud off --background white --screenshot ";
  EXPECT_EQ(test::presa(how + with + " --show joints").status, 0);
  EXPECT_EQ(test::presa(how + none).status, 0);
  EXPECT_EQ(test::violetIn(none), 0);
  EXPECT_GT(test::violetIn(with), 200);
}

TEST(JointResults, ExplainAndCheckTellOfThem) {
  const std::string scene = jointMachine();
  const std::string text = test::presa("explain " + scene).out;
  EXPECT_THAT(
      text,
      HasSubstr("axle                  hinge of wheel to the world about 0 0 1, motor to 7 rad/s with up to 5 N m"));
  EXPECT_THAT(text, HasSubstr("slider of weight to the world along 0 0 1, from -50.0 mm to 100.0 mm"));
  EXPECT_EQ(json::parse(test::presa("explain " + scene + " --format json").out)["joints"].size(), 3u);
  EXPECT_THAT(test::presa("check " + scene).out, HasSubstr("good (3 bodies, 3 joints, "));
}

}  // namespace
}  // namespace presa
