// An object that turns in the hand, and a hand that buckles: figures and verdict.
#include "apps/common/grasp_turn.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "tests/apps/support/support.h"
#include "tests/framework/record/monitor/synthetic_run.h"

namespace presa::test {
namespace {

constexpr double kHalf = 0.043;  // [m] from the middle to a fingertip

/// Two fingers on the cube; the line between them and the cube are turned about z, then the cube about the line.
TraceSample held(double time, double hand, double object) {
  const Quat q(Eigen::AngleAxisd(hand, Vec3::UnitZ()));
  TraceSample sample;
  sample.time = time;
  sample.fingers.resize(2);
  for (const std::size_t f : {0U, 1U}) {
    sample.fingers[f].mode = ContactMode::kStick;
    sample.fingers[f].body = kCube;
    sample.fingers[f].p_WP = Vec3(0.1, 0.2, 0.3) + q * Vec3(f == 0 ? -kHalf : kHalf, 0, 0);
  }
  sample.bodies[0].q = q * Quat(Eigen::AngleAxisd(object, Vec3::UnitX()));
  return sample;
}

constexpr TracedGrasp kBoth{.first = 0, .second = 1, .body = kCube, .slot = 0};

TEST(GraspTurn, TellsTheHandFromTheObjectInIt) {
  const auto world = pinchWorld();
  const auto turn = graspTurn(*world, std::vector{held(0, 0.2, 0.1), held(1, 0.7, 1.3)}, 0.5, kBoth);
  ASSERT_TRUE(turn);
  EXPECT_NEAR(turn->hand, 0.5, 1e-12);
  EXPECT_NEAR(turn->object, 1.2, 1e-12);
  EXPECT_NEAR(turn->sideways, kHalf * std::sin(0.5), 1e-12);
  EXPECT_TRUE(turn->handBuckled());
  EXPECT_TRUE(turn->objectTurned());
}

// A grasp that was lost before the hold is none: what counts begins with the next one.
TEST(GraspTurn, BeginsWithTheGraspThatIsHeld) {
  const auto world = pinchWorld();
  TraceSample lost = held(0.1, 0, 0);
  lost.fingers[1].mode = ContactMode::kNone;
  const auto turn = graspTurn(*world, std::vector{held(0, 0, 0), lost, held(0.2, 0.6, 0), held(1, 0.6, 0)}, 0.5, kBoth);
  ASSERT_TRUE(turn);
  EXPECT_NEAR(turn->hand, 0, 1e-12);
}

// A user who walks takes the hand along: the frame turns, and the hand in it does not. On the tool of a device the
// frame is not known.
TEST(GraspTurn, IsSeenFromTheFrameOfTheDevices) {
  const auto world = pinchWorld();
  Frame user;
  user.name = "user";
  user.parent = kWorldFrame;
  Pose turned;
  turned.q = Quat(Eigen::AngleAxisd(0.7, Vec3::UnitZ()));
  user.keys = {{0, Pose{}}, {1, turned}};
  world->rig.frames = {user};
  for (const char* role : {"thumb", "index"}) {
    DeviceBinding binding;
    binding.role = role;
    binding.frame = "user";
    world->rig.devices.push_back(binding);
  }
  const std::vector trace{held(0, 0, 0), held(1, 0.7, 0)};
  const auto turn = graspTurn(*world, trace, 0.5, kBoth);
  ASSERT_TRUE(turn);
  EXPECT_NEAR(turn->hand, 0, 1e-12);
  EXPECT_NEAR(turn->object, 0, 1e-12);
  world->rig.frames[0].parent = "thumb";
  EXPECT_FALSE(graspTurn(*world, trace, 0.5, kBoth));
}

/// Result of the shipped pinch, its motion changed: the place of the grasp and the grip force.
nlohmann::json pinch(const std::string& point, const std::string& grip, std::string& told) {
  std::stringstream motion;
  motion << std::ifstream(source("config/motions/pinch_cube.xml")).rdbuf();
  std::string text = motion.str();
  const auto change = [&](const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
  };
  change("point=\"0 0 0.040\"", "point=\"" + point + "\"");
  change("grip=\"6\"", "grip=\"" + grip + "\"");
  const std::string changed = scratch("pinch.xml"), rig = scratch("pinch_rig.xml"), summary = scratch("pinch.json");
  std::ofstream(changed) << text;
  std::ofstream(rig)
      << "<rig version=\"1.0\" name=\"pinch\">"
         "<device role=\"thumb\" driver=\"scripted\"><set key=\"motion\" value=\"pinch.xml\"/></device>"
         "<device role=\"index\" driver=\"scripted\"><set key=\"motion\" value=\"pinch.xml\"/></device></rig>";
  const Outcome run = presa("run " + source("config/scenes/cube.xml") + " --rig " + rig +
                            " --set device/thumb/limits/force=60 --set device/index/limits/force=60 --lockstep --view "
                            "none --summary " +
                            summary);
  EXPECT_EQ(run.status, 0) << run.err;
  told = run.out;
  std::ifstream file(summary);
  return nlohmann::json::parse(file).at("grasp");
}

// 2 mm beside the centre of mass and 5 mm below it: the cube hangs over, and comes to rest half a turn away.
TEST(GraspVerdict, NamesACubeThatTurnsInTheGrip) {
  std::string told;
  const nlohmann::json grasp = pinch("0 0.002 0.030", "6", told);
  EXPECT_NEAR(grasp.at("held_in_stick_s").get<double>(), 4, 0.002);
  EXPECT_GT(grasp.at("turn").at("object_deg").get<double>(), 150);  // an undamped pendulum from the top swings over
  EXPECT_TRUE(grasp.at("turn").at("turned_in_grip").get<bool>());
  EXPECT_FALSE(grasp.at("turn").at("hand_buckled").get<bool>());
  EXPECT_NE(told.find(" of 4.00 s, but turned by 1"), std::string::npos) << told;
  EXPECT_NE(told.find("° in the grip"), std::string::npos) << told;
}

// Two fingers that push with F and are k stiff sideways fold from F = k d on, d from the middle to a fingertip: 12.9 N
// at 300 N/m and 43 mm. With 14.2 N they fold within the hold, and with 6 N they stay straight.
TEST(GraspVerdict, NamesAHandThatBuckles) {
  std::string told;
  const nlohmann::json grasp = pinch("0 0.002 0.040", "14.2", told);
  EXPECT_NEAR(grasp.at("held_in_stick_s").get<double>(), 4, 0.002);
  EXPECT_TRUE(grasp.at("turn").at("hand_buckled").get<bool>());
  EXPECT_GT(grasp.at("turn").at("fingers_sideways_mm").get<double>(), 1000 * kHalf * std::sin(GraspTurn::kMax));
  EXPECT_NE(told.find("a hand that buckled"), std::string::npos) << told;
  EXPECT_NE(told.find("mm sideways"), std::string::npos) << told;
}

TEST(GraspVerdict, SaysNothingOfAStraightHold) {
  std::string told;
  const nlohmann::json grasp = pinch("0 0 0.040", "6", told);
  EXPECT_LT(grasp.at("turn").at("object_deg").get<double>(), 0.1);
  EXPECT_LT(grasp.at("turn").at("hand_deg").get<double>(), 0.1);
  EXPECT_NE(told.find("held in stick for 4.00 of 4.00 s\n"), std::string::npos) << told;
}

}  // namespace
}  // namespace presa::test
