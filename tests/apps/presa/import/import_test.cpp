// URDF and MJCF become scenes: where links are, what joints do, and what is said of the rest.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "apps/common/scratch_folder.h"
#include "apps/presa/import/import_robot.h"
#include "tests/apps/support/support.h"

namespace presa::robot {
namespace {

using std::numbers::pi;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string kFixtures = PRESA_SOURCE_DIR "/tests/apps/presa/import/fixtures/";

/// A scene made of a file, and the world that it loads.
class Import : public testing::Test {
 protected:
  void import(const std::string& file, bool free_base = false) {
    wanted_.file = file;
    wanted_.folder = scratch_.file("out");
    wanted_.free_base = free_base;
    const auto imported = importRobot(wanted_, found_);
    ASSERT_TRUE(imported) << found_.text();
    said_ = leftOutText(*imported);
    scene_ = write(wanted_.folder, *imported);
    world_ = loadWorld({scene_, "", {}}, {}, found_).world;
    ASSERT_TRUE(world_) << found_.text();
  }
  /// The scene with its fingers out of the way.
  std::unique_ptr<TerminalRun> run(double duration) {
    RunOptions options;
    options.duration = duration;
    const std::string away = scene_.substr(0, scene_.size() - std::string(".xml").size()) + "_away.xml";
    Loaded loaded = loadWorld({scene_, away, {}}, options, found_);
    if (found_.hasErrors()) throw InputError(found_);
    auto made = std::make_unique<TerminalRun>(std::move(loaded),
                                              TerminalRun::Settings{.trace_rate = 1000, .quiet = true, .command = ""});
    made->execute();
    return made;
  }
  /// Of this text as a file.
  std::string refusal(const std::string& text) {
    wanted_.file = scratch_.file("bad.xml");
    std::ofstream(wanted_.file) << text;
    EXPECT_FALSE(importRobot(wanted_, found_));
    const std::string said = found_.text();
    found_ = {};
    return said;
  }
  const Body& body(const std::string& name) const { return world_->scene.bodies.at(indexOf(name)); }
  const BodyInertia& inertia(const std::string& name) const { return world_->inertias.at(indexOf(name)); }
  std::size_t indexOf(const std::string& name) const {
    for (std::size_t i = 0; i < world_->scene.bodies.size(); ++i)
      if (world_->scene.bodies[i].name == name) return i;
    ADD_FAILURE() << "no body " << name;
    return 0;
  }
  const Joint& joint(const std::string& name) const {
    for (const Joint& joint : world_->scene.joints)
      if (joint.name == name) return joint;
    throw std::runtime_error("no joint " + name);
  }

  /// Pose of one of the first four free bodies `back` samples before the end.
  static Pose traced(const RunResult& result, const std::string& name, std::size_t back = 0) {
    for (const RunResult::Object& object : result.objects) {
      if (object.name != name || object.trace_slot < 0) continue;
      return (*result.trace)[result.trace->size() - 1 - back].bodies.at(static_cast<std::size_t>(object.trace_slot));
    }
    throw std::runtime_error(name + " is not traced");
  }

  ScratchFolder scratch_;
  Wanted wanted_;
  Diagnostics found_;
  std::string said_, scene_;
  std::shared_ptr<const World> world_;
};

constexpr double kText = 1e-8;  // nine digits in the scene

void expectNear(const Vec3& found, const Vec3& expected, double tolerance = kText) {
  EXPECT_LT((found - expected).norm(), tolerance) << found.transpose() << " instead of " << expected.transpose();
}

// The wrist turns the palm by 90 degrees: what is along x in the palm is along y in the world.
TEST_F(Import, LinksOfAUrdfAreWhereItsJointsPutThem) {
  import(kFixtures + "gripper/urdf/gripper.urdf");
  expectNear(body("palm").X_WB.p, {0, 0, 0.01});
  expectNear(body("left_finger").X_WB.p, {0, 0.05, 0.07});
  expectNear(body("left_finger").X_WB.q * Vec3::UnitX(), Vec3::UnitY());
  expectNear(body("knob").X_WB.p, {0.035, 0, 0.04});
  EXPECT_TRUE(body("base").fixed);
  EXPECT_EQ(world_->scene.bodies.size(), 4u) << "the label is glued to the palm";
}

TEST_F(Import, InertiasAreThoseOfTheFile) {
  import(kFixtures + "gripper/urdf/gripper.urdf");
  const BodyInertia& palm = inertia("palm");
  EXPECT_NEAR(palm.mass, 0.4, kText);
  expectNear(palm.p_BCm, {0, 0, 0.03});
  Mat3 expected;
  expected << 3e-4, 0, 1e-5, 0, 4e-4, 0, 1e-5, 0, 2e-4;
  EXPECT_LT((palm.inertia - expected).norm(), 1e-11) << palm.inertia;
}

TEST_F(Import, JointsHaveLimitsFrictionAndDamping) {
  import(kFixtures + "gripper/urdf/gripper.urdf");
  const Joint& wrist = joint("wrist");
  ASSERT_EQ(wrist.axes.size(), 1u);
  EXPECT_NEAR(*wrist.axes[0].lower, -1, kText);
  EXPECT_NEAR(*wrist.axes[0].upper, 2, kText);
  EXPECT_NEAR(wrist.axes[0].damping, 0.01, kText);
  EXPECT_NEAR(wrist.axes[0].friction, 0.002, kText);
  EXPECT_FALSE(joint("turn").axes[0].lower || joint("turn").axes[0].upper);
  EXPECT_NEAR(*joint("slide").axes[0].upper, 0.04, kText);
}

TEST_F(Import, WhatIsLeftOutIsSaid) {
  import(kFixtures + "gripper/urdf/gripper.urdf");
  EXPECT_THAT(said_, AllOf(HasSubstr("<transmission>, 2 times, the first at"), HasSubstr("<gazebo> at"),
                           HasSubstr("<mimic> at"), HasSubstr("effort and velocity of <limit>, 2 times")));
  EXPECT_THAT(said_, HasSubstr("gripper.urdf:39"));
}

// A wedge of 30 x 20 x 10 mm, given in millimetres, and a box.
TEST_F(Import, FingersFeelAllSolidsOfALink) {
  import(kFixtures + "gripper/urdf/gripper.urdf");
  const TriMesh& felt = *world_->meshes[indexOf("left_finger")].haptic;
  EXPECT_NEAR(massProperties(felt).volume, 0.5 * 0.03 * 0.02 * 0.01 + 0.01 * 0.02 * 0.02, 1e-11);
  EXPECT_TRUE(checkMesh(felt).closed());
  EXPECT_TRUE(std::holds_alternative<Compound>(body("left_finger").physics->shape));
}

// Two bodies that start away from each other fall as one: what is between them is a joint, nothing else.
TEST_F(Import, TheRootIsFreeOnDemand) {
  import(kFixtures + "gripper/urdf/gripper.urdf", true);
  EXPECT_FALSE(body("base").fixed);
  EXPECT_EQ(joint("wrist").body, indexOf("palm"));
}

// Small swings of a rigid body, with the inertia that the file gives and its ball does not have: the period of a swing of
// 0.1 rad is longer by 0.1^2 / 16.
TEST_F(Import, APendulumHasThePeriodOfItsFile) {
  import(kFixtures + "gripper/urdf/pendulum.urdf");
  const double period = 2 * pi * std::sqrt((2e-3 + 0.5 * 0.09) / (0.5 * 9.81 * 0.3)) * (1 + 0.01 / 16);
  const auto swung = run(10 * period);
  const Pose X_WB = traced(swung->result(), "bob");
  const double angle = 2 * std::atan2(X_WB.q.y(), X_WB.q.w());
  // an angle at rest at its turning point after ten periods; one that were late by 0.1 % would be off by 2e-4 rad
  EXPECT_NEAR(angle, 0.1, 1e-4);
}

TEST_F(Import, MjcfHasItsDefaultsFramesAndIncludes) {
  import(kFixtures + "mjcf/toys.xml");
  expectNear(world_->scene.gravity, {0, 0, -1.62});
  EXPECT_TRUE(body("ground").fixed);
  const auto& post = std::get<Capsule>(body("post").haptic->shape);
  EXPECT_NEAR(post.length, 0.4, kText);
  expectNear(body("post").X_WB.p, {0.5, 0, 0.2});
  EXPECT_NEAR(inertia("ball").mass, 0.2, kText);
  EXPECT_NEAR(world_->scene.materialOf(body("egg")).friction_static, 0.3, kText);
  EXPECT_NEAR(world_->scene.materialOf(body("ball")).friction_static, 0.7, kText);
  EXPECT_NEAR(inertia("egg").mass, 500 * 4.0 / 3 * pi * 0.02 * 0.03 * 0.04, 1e-6);
  ASSERT_EQ(world_->scene.plugin_elements.size(), 1u);
  EXPECT_EQ(world_->scene.plugin_elements[0].body, static_cast<std::int32_t>(indexOf("egg")));
  EXPECT_EQ(world_->scene.plugin_elements[0].number("share"), 0.5);
  // of a class of defaults
  const JointAxis& rail = joint("rail").axes[0];
  EXPECT_NEAR(rail.stiffness, 20, kText);
  EXPECT_NEAR(rail.rest, 0.02, kText);
  EXPECT_NEAR(*rail.lower, -0.3, kText);
}

TEST_F(Import, SeveralJointsOfABodyBecomeOne) {
  import(kFixtures + "mjcf/toys.xml");
  const Joint& mast = joint("roll");
  ASSERT_EQ(mast.axes.size(), 2u);  // universal
  EXPECT_NEAR(*mast.axes[0].lower, -pi / 6, kText);
  EXPECT_NEAR(*mast.axes[0].upper, pi / 4, kText);
  EXPECT_FALSE(mast.axes[1].lower);
  EXPECT_THAT(said_, AllOf(HasSubstr("'puck' moves freely"), HasSubstr("the limits of a ball joint are left out"),
                           HasSubstr("<actuator>"), HasSubstr("<sensor>"), HasSubstr("<keyframe>"),
                           HasSubstr("<texture>"), HasSubstr("<camera>"), HasSubstr("<site>")));
}

// The whole runs: nothing explodes, and the ball lies on the ground in the end.
TEST_F(Import, TheToysComeToRest) {
  import(kFixtures + "mjcf/toys.xml");
  const auto fallen = run(4);
  EXPECT_NEAR(traced(fallen->result(), "ball").p.z(), 0.05, 1e-3);
  constexpr double kSamples = 100, kRate = 1000;  // of the trace
  for (const char* name : {"ball", "egg", "cart"}) {
    const Vec3 way = traced(fallen->result(), name).p - traced(fallen->result(), name, kSamples).p;
    EXPECT_LT(way.norm() * kRate / kSamples, 0.5) << name;
  }
}

TEST_F(Import, MistakesAreFoundAtTheirPlaces) {
  EXPECT_THAT(refusal("<scene/>"),
              AllOf(HasSubstr("bad.xml:1:"), HasSubstr("error[E130]"), HasSubstr("neither URDF nor MJCF")));
  EXPECT_THAT(refusal("<robot name=\"a\"><link>"), HasSubstr("error[E104]"));
  EXPECT_THAT(refusal("<robot name=\"a\"><link name=\"b\"/><joint name=\"j\" type=\"hinge\"/></robot>"),
              AllOf(HasSubstr("error[E131]"), HasSubstr("no joint of type 'hinge'")));
  EXPECT_THAT(refusal("<mujoco><worldbody><geom size=\"nan\"/></worldbody></mujoco>"),
              AllOf(HasSubstr("error[E131]"), HasSubstr("'size' is not finite")));
  EXPECT_THAT(refusal("<robot name=\"a\">\n<link name=\"b\"/>\n<joint name=\"j\" type=\"fixed\"><parent link=\"b\"/>"
                      "<child link=\"c\"/></joint>\n</robot>"),
              AllOf(HasSubstr("error[E131]"), HasSubstr("MuJoCo cannot read the model")));
  EXPECT_THAT(refusal("<mujoco>\n<worldbody>\n<body>\n<freejoint/>\n<geom type=\"box\" size=\"1 "
                      "1\"/>\n</body></worldbody></mujoco>"),
              AllOf(HasSubstr("bad.xml:5:1"), HasSubstr("error[E131]")));
  EXPECT_THAT(
      refusal("<robot name=\"a\"><link name=\"b\"><visual><geometry>\n<mesh filename=\"no.stl\"/></geometry></visual>"
              "</link></robot>"),
      AllOf(HasSubstr("bad.xml:2:"), HasSubstr("error[E132]"), HasSubstr("no.stl")));
  EXPECT_THAT(refusal("<robot name=\"a\"><link name=\"b\"><visual><geometry>"
                      "<mesh filename=\"package://other/no.stl\"/></geometry></visual></link></robot>"),
              AllOf(HasSubstr("error[E132]"), HasSubstr("no folder 'other'")));
  EXPECT_THAT(refusal("<mujoco><worldbody><body name=\"b\"><joint type=\"hinge\"/><joint type=\"hinge\" pos=\"1 0 0\"/>"
                      "<geom size=\"1\"/></body></worldbody></mujoco>"),
              AllOf(HasSubstr("error[E133]"), HasSubstr("body 'b' has 2 joints")));
  EXPECT_THAT(refusal("<mujoco><include file=\"/etc/hostname\"/></mujoco>"), HasSubstr("error["));
}

// Lines inside of a comment, and names that look like one.
TEST_F(Import, PlacesAreThoseOfElements) {
  const std::string box = "<geom type=\"box\" size=\"1 1\"/>";
  EXPECT_THAT(refusal("<mujoco>\n<!--\n<worldbody>\n<body>\n-->\n<worldbody>\n<body name=\"line 99999999999\">\n" +
                      box + "\n</body></worldbody></mujoco>"),
              HasSubstr("bad.xml:8:1: error[E131]"));
  const std::string twice = "<body name=\"line 3\"><geom size=\"1\"/></body>";
  EXPECT_THAT(refusal("<mujoco><worldbody>" + twice + twice + "</worldbody></mujoco>"), HasSubstr("error[E131]"));
}

// Only Presa opens files, and each once.
TEST_F(Import, AHostileFileReachesNothing) {
  std::ofstream(scratch_.file("other.xml"))
      << "<mujoco><worldbody><geom name=\"leaked\" size=\"1\"/></worldbody></mujoco>";
  wanted_.file = scratch_.file("case.xml");
  std::ofstream(wanted_.file) << "<mujoco><worldbody><Include file=\"/proc/self/environ\"/></worldbody></mujoco>";
  EXPECT_FALSE(importRobot(wanted_, found_));
  EXPECT_THAT(found_.text(), HasSubstr("error[E692]"));
  found_ = {};
  EXPECT_THAT(refusal("<mujoco><include file=\"bad.xml\"/><include file=\"bad.xml\"/></mujoco>"),
              AllOf(HasSubstr("error[E132]"), HasSubstr("included a second time")));
  EXPECT_THAT(refusal("<mujoco><include file=\"other.xml\"/><include file=\"other.xml\"/></mujoco>"),
              HasSubstr("included a second time"));
  EXPECT_THAT(
      refusal("<mujoco><worldbody><composite type=\"grid\" count=\"9 9 1\" spacing=\"1\"/></worldbody></mujoco>"),
      HasSubstr("<composite> is not read"));
  EXPECT_THAT(refusal("<robot name=\"r\" xmlns:xacro=\"x\"><xacro:include filename=\"a\"/><link name=\"a\"/></robot>"),
              AllOf(HasSubstr("error[E130]"), HasSubstr("xacro")));
  // what MuJoCo would take memory for is not handed to it
  wanted_.file = scratch_.file("size.xml");
  std::ofstream(wanted_.file) << "<mujoco><size nkey=\"100000000\"/><worldbody><geom size=\"1\"/></worldbody></mujoco>";
  found_ = {};
  EXPECT_TRUE(importRobot(wanted_, found_)) << found_.text();
}

TEST_F(Import, WhatMuJoCoMeansIsKept) {
  const auto scene = [&](const std::string& text) {
    wanted_.file = scratch_.file("made.xml");
    std::ofstream(wanted_.file) << text;
    found_ = {};
    const auto imported = importRobot(wanted_, found_);
    EXPECT_TRUE(imported) << found_.text();
    said_ = imported ? leftOutText(*imported) : "";
    return imported ? imported->files.scene : "";
  };
  EXPECT_THAT(scene("<mujoco><option integrator=\"implicitfast\"><flag gravity=\"disable\"/></option><worldbody>"
                    "<geom size=\"1\" condim=\"1\" rgba=\"255 0 0 1\"/></worldbody></mujoco>"),
              AllOf(HasSubstr("gravity=\"0 0 0\""), HasSubstr("color=\"1 0 0\""), Not(HasSubstr("friction"))));
  scene(
      "<mujoco><worldbody><geom size=\"1\"/><body name=\"a\" pos=\"0 0 3\"><freejoint/><geom size=\"1\" contype=\"2\" "
      "conaffinity=\"4\"/></body></worldbody></mujoco>");
  EXPECT_THAT(said_, HasSubstr("keep some solids apart"));
  EXPECT_THAT(
      scene("<mujoco><worldbody><body name=\"hand\" mocap=\"true\"><geom size=\"1\"/></body></worldbody></mujoco>"),
      HasSubstr("<body name=\"hand\" fixed=\"true\""));
  // a table that moves in two directions between stops is no free body
  EXPECT_THAT(refusal("<mujoco><worldbody><body name=\"xy\"><joint type=\"slide\" axis=\"1 0 0\"/>"
                      "<joint type=\"slide\" axis=\"0 1 0\"/>\n<geom size=\"1\"/></body></worldbody></mujoco>"),
              AllOf(HasSubstr("bad.xml:1:"), HasSubstr("error[E133]")));
  EXPECT_THAT(refusal("<robot name=\"r\"><link name=\"a\"><visual><geometry><mesh filename=\"a.stl\" scale=\"0.001\"/>"
                      "</geometry></visual></link></robot>"),
              HasSubstr("three numbers"));
}

// Boxes that share a face, and one that is there twice.
TEST_F(Import, SolidsThatCoincideAreFelt) {
  wanted_.file = scratch_.file("stack.xml");
  const std::string box = "<geom type=\"box\" size=\"0.05 0.05 0.05\" pos=\"0 0 ";
  std::ofstream(wanted_.file) << "<mujoco><worldbody><body name=\"stack\"><freejoint/>" + box + "0\"/>" + box +
                                     "0.1\"/>" + box + "0.1\"/></body></worldbody></mujoco>";
  import(wanted_.file);
  const TriMesh& felt = *world_->meshes[indexOf("stack")].haptic;
  EXPECT_TRUE(checkMesh(felt).closed());
  EXPECT_NEAR(massProperties(felt).volume, 3e-3, 3e-3 * 3 * 3e-4);
}

// The moments of a thin plate, whose largest is the sum of the others to the last digit.
TEST_F(Import, AThinPlateIsARealBody) {
  wanted_.file = scratch_.file("plate.urdf");
  std::ofstream(wanted_.file)
      << R"(<robot name="plate"><link name="base"/><link name="plate"><inertial><mass value="0.1"/>
<inertia ixx="3.333333333333333e-4" iyy="3.333333333333333e-4" izz="6.666666666666666e-4" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><geometry><box size="0.2 0.2 0.001"/></geometry></collision></link>
<joint name="j" type="continuous"><parent link="base"/><child link="plate"/></joint></robot>)";
  import(wanted_.file);
  EXPECT_NEAR(inertia("plate").inertia(2, 2), 6.666666666666666e-4, 1e-18);
}

TEST_F(Import, NothingIsReplacedUnasked) {
  import(kFixtures + "gripper/urdf/pendulum.urdf");
  checkTarget(wanted_, found_);
  EXPECT_THAT(found_.text(), HasSubstr("error[E129]"));
  found_ = {};
  wanted_.overwrite = true;
  checkTarget(wanted_, found_);
  EXPECT_FALSE(found_.hasErrors());
  // nor the file that is read
  wanted_.folder = scratch_.file("");
  wanted_.file = scratch_.file("toy.xml");
  std::ofstream(wanted_.file) << "<mujoco><worldbody><geom size=\"1\"/></worldbody></mujoco>";
  EXPECT_FALSE(importRobot(wanted_, found_));
  EXPECT_THAT(found_.text(), AllOf(HasSubstr("error[E129]"), HasSubstr("would replace it")));
}

}  // namespace
}  // namespace presa::robot
