#include <cmath>

#include "framework/scene/joints/joint.h"
#include "tests/framework/scene/scene_text.h"

namespace presa::scene_test {
namespace {

/// The small scene with joints before its devices.
std::string withJoints(const std::string& joints, std::string scene = kScene) {
  return scene.insert(scene.find("  <devices>"), joints);
}

const std::string kDoor = R"(  <joint name="hinge" type="hinge" body="cube" to="table" pos="0 0 -0.03">)"
                          R"(<axis dir="0 0 2" lower_deg="-90" upper_deg="0" friction="0.1"/></joint>
)";

TEST(JointElement, IsReadWithItsUnits) {
  Diagnostics findings;
  const Scene scene = parseScene(withJoints(kDoor), "scene.xml", "/lab", {}, findings);
  ASSERT_TRUE(findings.all().empty()) << findings.text();
  ASSERT_EQ(scene.joints.size(), 1U);
  const Joint& joint = scene.joints[0];
  EXPECT_EQ(joint.type, JointType::kHinge);
  EXPECT_EQ(scene.bodies[joint.body].name, "cube");
  EXPECT_EQ(scene.bodies[joint.to].name, "table");
  EXPECT_EQ(joint.p_BJ, Vec3(0, 0, -0.03));
  EXPECT_EQ(joint.axes[0].dhat_B, Vec3(0, 0, 1));
  EXPECT_NEAR(*joint.axes[0].lower, -std::acos(0), 1e-15);
  EXPECT_EQ(*joint.axes[0].upper, 0);
  EXPECT_EQ(joint.axes[0].friction, 0.1);
}

TEST(JointElement, TakesValuesFromTheCommandLine) {
  Diagnostics findings;
  const Scene scene =
      parseScene(withJoints(kDoor), "scene.xml", "/lab", {{"joint/hinge/axis/upper_deg", "30"}}, findings);
  ASSERT_TRUE(findings.all().empty()) << findings.text();
  EXPECT_NEAR(*scene.joints[0].axes[0].upper, std::acos(0) / 3, 1e-15);
}

/// One mistake in the joint: `to` replaces `from` and marks with '@' the expected place of the message.
struct JointSlip {
  const char* name;
  int code;
  const char* from;
  const char* to;
  const char* says;
};
class OneJointSlip : public testing::TestWithParam<JointSlip> {};

TEST_P(OneJointSlip, GivesOneMessageAtItsPlace) {
  const JointSlip& slip = GetParam();
  const Marked scene = marked(withJoints(edited(kDoor, slip.from, slip.to)));
  const Diagnostics findings = findingsOf(scene.text);
  ASSERT_EQ(findings.all().size(), 1U) << findings.text();
  const Diagnostic& finding = findings.all()[0];
  EXPECT_EQ(finding.code, slip.code) << findings.text();
  EXPECT_EQ(finding.where.line, scene.line) << findings.text();
  EXPECT_EQ(finding.where.column, scene.column) << findings.text();
  EXPECT_NE((finding.message + "\n" + finding.help).find(slip.says), std::string::npos) << findings.text();
}

const JointSlip kJointSlips[] = {
    {"UnknownBody", 229, "body=\"cube\"", "@body=\"cub\"", "did you mean 'cube'"},
    {"UnknownTo", 229, "to=\"table\"", "@to=\"tabel\"", "did you mean 'table'"},
    {"Itself", 229, "to=\"table\"", "@to=\"cube\"", "to itself"},
    {"TwoFixed", 229, "body=\"cube\" to=\"table\"", "@body=\"table\"", "nothing can move"},
    {"NoAxis", 230, "  <joint name=\"hinge\" type=\"hinge\"", "  @<joint name=\"hinge\" type=\"universal\"",
     "2 <axis>"},
    {"AxisOfFixed", 230, "type=\"hinge\" body=\"cube\" to=\"table\" pos=\"0 0 -0.03\"><axis",
     "type=\"fixed\" body=\"cube\" to=\"table\" pos=\"0 0 -0.03\">@<axis", "a fixed has 0 <axis>"},
    {"MetresOfATurn", 230, "lower_deg=\"-90\"", "@lower=\"-1\"", "lower_deg"},
    {"NoDirection", 231, "dir=\"0 0 2\"", "@dir=\"0 0 0\"", "length zero"},
    {"MissingDirection", 231, "<axis dir=\"0 0 2\"", "@<axis", "no 'dir'"},
    {"NotSquare", 231, "type=\"hinge\" body=\"cube\" to=\"table\" pos=\"0 0 -0.03\"><axis dir=\"0 0 2\"",
     "type=\"universal\" body=\"cube\" to=\"table\" pos=\"0 0 -0.03\"><axis dir=\"1 0 0\"/><axis @dir=\"1 2 0\"",
     "an angle of 63.4 degrees"},
    {"SecondOfOneName", 203, "</joint>\n", "</joint>\n  <joint @name=\"hinge\" type=\"ball\" body=\"cube\"/>\n",
     "a second joint is named 'hinge'"},
    {"Crossed", 232, "lower_deg=\"-90\" upper_deg=\"0\"", "@lower_deg=\"10\" upper_deg=\"0\"", "is above"},
    {"StartsOutside", 232, "lower_deg=\"-90\" upper_deg=\"0\"", "@lower_deg=\"5\" upper_deg=\"20\"", "start pose"},
    {"BeyondHalfATurn", 232, "lower_deg=\"-90\"", "@lower_deg=\"-190\"", ">= -180"},
    {"MotorWithoutBound", 230, "friction=\"0.1\"", "@speed=\"1\"", "max_force"},
    {"Type", 116, "type=\"hinge\"", "@type=\"hing\"", "did you mean 'hinge'"},
    {"NegativeFriction", 117, "friction=\"0.1\"", "@friction=\"-1\"", "0"},
};
INSTANTIATE_TEST_SUITE_P(Joints, OneJointSlip, testing::ValuesIn(kJointSlips),
                         [](const auto& param) { return std::string(param.param.name); });

/// A rod between two fixed posts, each end on a hinge.
std::string rodOnTwoHinges(const std::string& second_axis) {
  return withJoints(R"(  <joint name="a" type="hinge" body="cube" pos="0 0 0.1"><axis dir="0 0 1"/></joint>
  <joint name="b" type="hinge" body="cube" pos="0 0 -0.1"><axis dir=")" +
                    second_axis + "\"/></joint>\n");
}

TEST(JointLoop, MovesAlongACommonAxis) {
  const Diagnostics findings = findingsOf(rodOnTwoHinges("0 0 -3"));
  EXPECT_TRUE(findings.all().empty()) << findings.text();
}

TEST(JointLoop, ThatCannotMoveIsRefused) {
  const Diagnostics findings = findingsOf(rodOnTwoHinges("1 0 0"));
  ASSERT_EQ(findings.all().size(), 1U) << findings.text();
  EXPECT_EQ(findings.all()[0].code, 233);
  EXPECT_NE(findings.text().find("'a', 'b' close a loop that cannot move"), std::string::npos) << findings.text();
}

// What the engine's own solver lacks, at its place.
class OneEngineSlip : public testing::TestWithParam<JointSlip> {};

TEST_P(OneEngineSlip, GivesOneMessageAtItsPlace) {
  const JointSlip& slip = GetParam();
  const std::string joint = edited(kDoor, slip.from, slip.to);
  for (const std::string solver : {"solver=\"direct\"", "solver=\"iterative\"", "friction=\"pyramid\""}) {
    const std::string dynamics = "  <dynamics " + solver + "/>\n  <materials>";
    const Marked scene = marked(withJoints(joint, edited(kScene, "  <materials>", dynamics)));
    const Diagnostics findings = findingsOf(scene.text);
    ASSERT_EQ(findings.all().size(), 1U) << solver << findings.text();
    const Diagnostic& finding = findings.all()[0];
    EXPECT_EQ(finding.code, slip.code) << findings.text();
    EXPECT_EQ(finding.where.line, scene.line) << findings.text();
    EXPECT_EQ(finding.where.column, scene.column) << findings.text();
    EXPECT_NE(finding.message.find(slip.says), std::string::npos) << findings.text();
  }
  std::string own = joint;
  own.erase(own.find('@'), 1);
  EXPECT_TRUE(findingsOf(withJoints(own)).all().empty());  // Presa's own solvers have it
}

const JointSlip kEngineSlips[] = {
    {"Spring", 235, "friction=\"0.1\"", "@stiffness=\"2\"", "no springs"},
    {"Damper", 235, "friction=\"0.1\"", "@damping=\"2\"", "no springs"},
    {"FrictionAndMotor", 235, "friction=\"0.1\"", "@friction=\"0.1\" max_force=\"1\"", "either friction or a motor"},
    {"Universal", 235, kDoor.c_str(),
     "  @<joint name=\"u\" type=\"universal\" body=\"cube\" to=\"table\"><axis dir=\"1 0 0\"/><axis dir=\"0 1 "
     "0\"/></joint>\n",
     "no such universal"},
    {"PrismaticRotary", 235, kDoor.c_str(),
     "  @<joint name=\"u\" type=\"prismatic_rotary\" body=\"cube\"><axis dir=\"1 0 0\"/><axis dir=\"0 1 "
     "0\"/></joint>\n",
     "no such prismatic_rotary"},
    {"BallWithFriction", 235, kDoor.c_str(),
     "  @<joint name=\"u\" type=\"ball\" body=\"cube\"><axis friction=\"1\"/></joint>\n", "no such ball"},
};
INSTANTIATE_TEST_SUITE_P(Joints, OneEngineSlip, testing::ValuesIn(kEngineSlips),
                         [](const auto& param) { return std::string(param.param.name); });

// A quarter turn of the door about the hinge, and a drawer pulled by 30 mm.
TEST(JointPosition, IsTheMotionAgainstTheOtherBody) {
  Joint joint;
  joint.p_BJ = {0.1, 0.2, 0};
  joint.axes.emplace_back();
  const Pose X_WB{{1, 2, 3}, Quat(Eigen::AngleAxisd(0.5, Vec3(1, 2, 3).normalized()))};
  const Pose X_WA{{-1, 0, 2}, Quat(Eigen::AngleAxisd(-1, Vec3(0, 2, 1).normalized()))};
  const JointFrames frames = framesOf(joint, X_WB, X_WA);
  EXPECT_NEAR(positionOf(joint, 0, poseOf(frames, X_WB, X_WA)), 0, 1e-15);
  const Pose X_BJ{joint.p_BJ, Quat::Identity()};
  const Pose turned = X_WB * X_BJ * Pose{{0, 0, 0}, Quat(Eigen::AngleAxisd(0.7, Vec3::UnitZ()))} * X_BJ.inverse();
  EXPECT_NEAR(positionOf(joint, 0, poseOf(frames, turned, X_WA)), 0.7, 1e-14);
  joint.type = JointType::kSlider;
  joint.axes[0].turns = false;
  const Pose moved = X_WB * Pose{{0, 0, 0.03}, Quat::Identity()};
  EXPECT_NEAR(positionOf(joint, 0, poseOf(frames, moved, X_WA)), 0.03, 1e-15);
}

}  // namespace
}  // namespace presa::scene_test
