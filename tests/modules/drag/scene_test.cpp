#include <gtest/gtest.h>

#include <fstream>

#include "tests/apps/support/support.h"
#include "tests/support/lockstep_run.h"

// From the command line: the shipped cube with body effects, from XML alone.
namespace presa {
namespace {

using test::Outcome;
using test::withTestPlugins;

std::string cubeWith(const std::string& text, const std::string& start, const std::string& name) {
  return test::cubeWith(name, [&](std::string& xml) { xml.insert(xml.find('>', xml.find(start)) + 1, text); });
}
std::string dragOnCube(const std::string& attributes, const std::string& name) {
  return cubeWith("<drag " + attributes + "/>", "<body name=\"cube\"", name);
}

Outcome run(const std::string& scene, const std::string& more = "") {
  return withTestPlugins("run", scene, " --lockstep --for 2" + more);
}

TEST(SceneWithDrag, LoadsItsPlugInAndShowsIt) {
  const std::string scene = dragOnCube("max_force=\"1\" linear=\"1\"", "drag.xml");
  const Outcome explained = withTestPlugins("explain", scene);
  EXPECT_EQ(explained.status, 0) << explained.err;
  EXPECT_NE(explained.out.find("body effect <drag> of body 'cube'"), std::string::npos) << explained.out;
  EXPECT_NE(explained.out.find("presa_drag.so"), std::string::npos) << explained.out;
  EXPECT_EQ(run(scene).status, 0);
}

// The medium resists at most 0.2 N s/m * 0.4 m/s, 4 % of the weight: the cube rises with the fingers as it does without.
TEST(SceneWithDrag, LetsTwoFingersLiftTheCube) {
  const std::string scene = test::cubeWith("drag_lift.xml", [](std::string& xml) {
    const std::string rig = "../rigs/pinch_cube.xml", cube = "<body name=\"cube\"";
    xml.replace(xml.find(rig), rig.size(), test::source("config/rigs/pinch_cube.xml"));
    xml.insert(xml.find('>', xml.find(cube)) + 1, "<drag max_force=\"1\" linear=\"0.2\"/>");
  });
  const test::LockstepRun run(scene);
  EXPECT_GT(run.rise("cube"), 0.09);  // the motion lifts by 0.101 m
  EXPECT_TRUE(run.faults().empty()) << run.faults().front();
}

TEST(SceneWithoutDrag, LoadsNoneOfIt) {
  const Outcome explained = test::presa("explain " + test::source("config/scenes/cube.xml"));
  EXPECT_EQ(explained.status, 0) << explained.err;
  EXPECT_EQ(explained.out.find("presa_drag.so"), std::string::npos) << explained.out;
  EXPECT_EQ(explained.out.find("body effect <"), std::string::npos) << explained.out;
  // what it could call for
  EXPECT_NE(explained.out.find("the scene has no <drag>: slows a body"), std::string::npos) << explained.out;
}

TEST(SceneWithDrag, TakesValuesFromTheCommandLineByItsManifest) {
  const std::string scene = dragOnCube("max_force=\"1\"", "set.xml");
  EXPECT_EQ(withTestPlugins("check", scene, " --set body/cube/drag/linear=2").status, 0);
  const Outcome negative = withTestPlugins("check", scene, " --set body/cube/drag/linear=-2");
  EXPECT_EQ(negative.status, 2);
  const Outcome unbound = withTestPlugins("check", dragOnCube("linear=\"1\"", "unbound.xml"));
  EXPECT_NE(unbound.err.find("error[E115]: <drag> in body 'cube' has no 'max_force'"), std::string::npos)
      << unbound.err;
}

TEST(SceneWithDrag, IsRefusedByEnginesWithoutBodyEffects) {
  const std::string scene = test::scratch("bullet.xml");
  std::ofstream(scene) << R"(<scene version="1.0" name="bullet"><world gravity="0 0 -9.81"/><dynamics engine="bullet"/>
    <materials><material name="any" stiffness="1000"/></materials>
    <body name="ball"><physics mass="0.1"><sphere radius="0.03"/></physics><drag max_force="1" linear="1"/></body>
    </scene>)";
  const Outcome outcome = test::presa("explain " + scene);
  EXPECT_NE(outcome.err.find("error[E226]: <drag> is a body effect, which dynamics_bullet does not support"),
            std::string::npos)
      << outcome.out << outcome.err;
}

// The report names the element, and the forces on the fingers fade to zero.
TEST(BrokenBodyEffect, TakesTheForceToZeroAndIsNamed) {
  for (const std::string fault : {"nan", "too_much", "torque", "rate"}) {
    const std::string scene = cubeWith("<faulty_body max_force=\"1\" after=\"0.5\" fault=\"" + fault + "\"/>", "<scene",
                                       "body_" + fault + ".xml");
    const Outcome outcome = run(scene);
    EXPECT_NE(outcome.status, 0) << fault;
    EXPECT_NE((outcome.out + outcome.err).find("body effect <faulty_body>"), std::string::npos)
        << fault << outcome.out << outcome.err;
    // one finding, by its name
    EXPECT_NE(outcome.out.find("\n  1 fault, listed below"), std::string::npos) << fault << outcome.out;
  }
  const std::string good = cubeWith("<faulty_body max_force=\"1\" fault=\"good\"/>", "<scene", "body_good.xml");
  EXPECT_EQ(run(good).status, 0);
}

TEST(BrokenBodyEffect, ThatCannotBeMadeIsRefusedBeforeAnythingMoves) {
  const Outcome throws = run(cubeWith("<faulty_body max_force=\"1\" fault=\"throws\"/>", "<scene", "body_throws.xml"));
  EXPECT_EQ(throws.status, 2);
  EXPECT_NE(throws.err.find("error[E596]"), std::string::npos) << throws.err;
  EXPECT_NE(throws.err.find("no such field"), std::string::npos) << throws.err;
}

}  // namespace
}  // namespace presa
