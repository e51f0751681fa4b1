// From the command line: shipped scenes with a texture, and the shipped cube with one, from XML alone.
#include <gtest/gtest.h>

#include "tests/apps/support/support.h"
#include "tests/support/lockstep_run.h"

namespace presa {
namespace {

using test::LockstepRun, test::Outcome;

/// `presa VERB` for the shipped cube with `texture` in its rubber, which stands in line 8.
Outcome cubeWith(const std::string& verb, const std::string& texture, const std::string& more = {}) {
  const std::string scene =
      test::cubeWith("textured.xml", [&](std::string& xml) { xml.insert(xml.find("<friction "), texture); });
  return test::withTestPlugins(verb, scene, more);
}

TEST(SceneWithTexture, LoadsItOnlyWhereAMaterialHasOne) {
  const Outcome plain = test::presa("explain " + test::source("config/scenes/cube.xml"));
  EXPECT_EQ(plain.status, 0) << plain.err;
  EXPECT_EQ(plain.out.find("presa_texture.so"), std::string::npos) << plain.out;
  for (const std::string shape : {"sine", "grid", "noise"}) {
    const Outcome textured = test::presa("explain " + test::source("config/scenes/texture_" + shape + ".xml"));
    EXPECT_EQ(textured.status, 0) << textured.err;
    EXPECT_NE(textured.out.find("presa_texture.so"), std::string::npos) << textured.out;
    EXPECT_NE(textured.out.find("texture: " + shape + " of "), std::string::npos) << textured.out;
  }
}

TEST(SceneWithTexture, IsStrokedToTheEndOfTheScript) {
  for (const std::string shape : {"sine", "grid", "noise"}) {
    const LockstepRun run(test::source("config/scenes/texture_" + shape + ".xml"));
    EXPECT_TRUE(run.faults().empty()) << shape << ": " << run.faults().front();
    EXPECT_GT(run.maxNormalForce("index"), 0.3) << shape;
  }
}

TEST(BadTexture, IsRefusedWithItsPlaceBeforeAnythingMoves) {
  struct Case {
    std::string attributes, expected;
  };
  const Case cases[] = {
      {R"(shape="sinus" amplitude="0.0001" wavelength="0.001")", "no shape 'sinus'; there are sine, grid and noise"},
      {R"(shape="sine" amplitude="0.0002" wavelength="0.001")",
       "its slope reaches 1.25664, above 1; an amplitude of 0.159155 mm would be the largest"},
      {R"(shape="grid" amplitude="0.0002" wavelength="0.002" across="0.0006")", "its slope reaches"},
      {R"(shape="sine" amplitude="0.0001" wavelength="0.001" across="0.002")", "has no wavelength across"},
      {R"(shape="noise" amplitude="0.0001" wavelength="0.001" seed="1.5")", "the seed must be a whole number"},
  };
  for (const Case& bad : cases) {
    const Outcome outcome = cubeWith("run", "<texture " + bad.attributes + "/>", " --lockstep");
    EXPECT_EQ(outcome.status, 2) << bad.attributes;
    EXPECT_NE(outcome.err.find("textured.xml:8:80: error[E596]"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find(bad.expected), std::string::npos) << outcome.err;
  }
  for (const std::string attributes :
       {R"(shape="sine" amplitude="0.0001" wavelength="-0.001")", R"(shape="sine" amplitude="0.1" wavelength="0.001")",
        R"(shape="sine" amplitude="0.0001")"}) {
    const Outcome outcome = cubeWith("check", "<texture " + attributes + "/>");
    EXPECT_EQ(outcome.status, 2) << attributes;
    EXPECT_NE(outcome.err.find("textured.xml:8:"), std::string::npos) << outcome.err;
  }
}

TEST(BadTexture, OnACurvedBodyIsRefused) {
  const std::string scene = test::cubeWith("textured_sphere.xml", [](std::string& xml) {
    xml.insert(xml.find("<friction "), R"(<texture shape="sine" amplitude="0.0001" wavelength="0.002"/>)");
    const std::string box = "<haptic><box size=\"0.07 0.07 0.07\"/>";
    xml.replace(xml.find(box), box.size(), "<haptic><sphere radius=\"0.035\"/>");
  });
  const Outcome outcome = test::withTestPlugins("run", scene, " --lockstep");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("body 'cube' has no flat sides; a texture needs a box or a mesh"), std::string::npos)
      << outcome.err;
}

}  // namespace
}  // namespace presa
