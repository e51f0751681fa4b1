#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "tests/apps/support/support.h"

// From the command line: the shipped cube with another friction law, from XML alone.
namespace presa {
namespace {

using test::Outcome;

using test::withTestPlugins;

/// The shipped scene with `law` in the friction of its two materials.
std::string cubeWith(const std::string& law, const std::string& name) {
  return test::cubeWith(name, [&](std::string& xml) {
    for (std::size_t at = 0; (at = xml.find("<friction ", at)) != std::string::npos; ++at) {
      xml.replace(xml.find("/>", at), 2, ">" + law + "</friction>");
    }
  });
}

Outcome run(const std::string& scene, const std::string& more = {}) {
  return withTestPlugins("run", scene, " --lockstep" + more);
}

TEST(SceneWithDahl, LoadsItsLawAndNotTheCone) {
  const std::string scene = cubeWith("<dahl stiffness=\"2000\"/>", "dahl.xml");
  const Outcome explained = withTestPlugins("explain", scene);
  EXPECT_EQ(explained.status, 0) << explained.err;
  EXPECT_NE(explained.out.find("friction: friction_dahl\n"), std::string::npos) << explained.out;
  EXPECT_NE(explained.out.find("presa_friction_dahl.so"), std::string::npos);
  EXPECT_EQ(explained.out.find("presa_friction_cone.so"), std::string::npos);
  const Outcome cone = test::presa("explain " + test::source("config/scenes/cube.xml"));
  EXPECT_EQ(cone.out.find("presa_friction_dahl.so"), std::string::npos);
  EXPECT_NE(cone.out.find("presa_friction_cone.so"), std::string::npos);
}

// Two fingers carry the cube of 0.2 kg while their Coulomb force bears its weight: m g / (2 mu) = 1.635 N each. The
// fingers loosen at 1.5 N/s, so the slip is seen within 1 % above that.
TEST(SceneWithDahl, LiftsTheCubeAndLosesItAtTheCoulombForce) {
  const std::string summary = test::scratch("dahl.json");
  const Outcome outcome = run(cubeWith("<dahl stiffness=\"2000\"/>", "lift.xml"), " --summary " + summary);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  std::ifstream in(summary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const auto number = [&](const std::string& name, std::size_t from = 0) {
    const std::size_t at = text.find("\"" + name + "\":", from);
    return at == std::string::npos ? std::nan("") : std::stod(text.substr(at + name.size() + 3));
  };
  EXPECT_GT(number("lift_height_m"), 0.095);
  EXPECT_NEAR(number("normal_force_N", text.find("slip_onset\"")), 0.2 * 9.81 / (2 * 0.6), 0.01 * 1.635);
  EXPECT_EQ(outcome.out.find("mu_s"), std::string::npos);  // the cone's figure does not hold here
}

// Ten times stiffer than the surface the cube could not be held; the law is bounded like a surface, and holds it.
TEST(SceneWithDahl, LowersAStiffnessThatTheDeviceCannotRender) {
  const Outcome outcome = run(cubeWith("<dahl stiffness=\"20000\"/>", "stiff.xml"));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(
      (outcome.out + outcome.err).find("<dahl stiffness> of material 'rubber' of 20 N/mm is felt with 7.668 N/mm"),
      std::string::npos)
      << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("held in stick for 4.00 of 4.00 s"), std::string::npos) << outcome.out;
}

// <faulty_friction> has defaults for all its attributes.
TEST(Law, IsThereOnlyWhereItIsWritten) {
  const Outcome explained = withTestPlugins("explain", cubeWith("", "none.xml"));
  EXPECT_EQ(explained.status, 0) << explained.err;
  EXPECT_NE(explained.out.find("friction: friction_cone\n"), std::string::npos) << explained.out;
}

TEST(SceneWithDahl, ErrorsAreLikeThoseOfAnyElement) {
  const Outcome missing = run(cubeWith("<dahl/>", "missing.xml"));
  EXPECT_EQ(missing.status, 2);
  EXPECT_NE(missing.err.find("error[E115]: <dahl>"), std::string::npos) << missing.err;
  const Outcome twice = run(cubeWith("<dahl stiffness=\"1\"/><dahl stiffness=\"2\"/>", "twice.xml"));
  EXPECT_EQ(twice.status, 2) << twice.out;
  const Outcome two = run(cubeWith("<dahl stiffness=\"1\"/><faulty_friction fault=\"nan\"/>", "two.xml"));
  EXPECT_EQ(two.status, 2) << two.out;
  EXPECT_NE(two.err.find("error[E224]: friction of <material> 'rubber' names two laws, <dahl> and <faulty_friction>"),
            std::string::npos)
      << two.err;
}

TEST(BrokenLaw, TakesTheForceToZeroAndIsNamed) {
  for (const std::string fault : {"nan", "too_much"}) {
    const Outcome outcome = run(cubeWith("<faulty_friction fault=\"" + fault + "\"/>", fault + "_law.xml"), " --for 3");
    EXPECT_NE(outcome.status, 0) << fault;
    EXPECT_NE((outcome.out + outcome.err).find("friction law 'faulty_friction' of material 'rubber'"),
              std::string::npos)
        << outcome.out << outcome.err;
  }
}

TEST(BrokenLaw, ThatCannotBeMadeIsRefusedBeforeAnythingMoves) {
  const Outcome throws = run(cubeWith("<faulty_friction fault=\"throws\"/>", "throws_law.xml"));
  EXPECT_EQ(throws.status, 2);
  EXPECT_NE(throws.err.find("error[E596]"), std::string::npos) << throws.err;
  EXPECT_NE(throws.err.find("no such surface"), std::string::npos) << throws.err;
}

}  // namespace
}  // namespace presa
