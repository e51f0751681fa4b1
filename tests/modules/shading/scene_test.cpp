#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "tests/apps/support/support.h"

// From the command line: the shipped scenes with surface effects, from XML alone.
namespace presa {
namespace {

using test::Outcome, test::withTestPlugins;

/// The shipped cube with `layer` in its two materials.
std::string cubeWith(const std::string& layer, const std::string& name) {
  return test::cubeWith(name, [&](std::string& xml) {
    for (std::size_t at = 0; (at = xml.find("<friction ", at)) != std::string::npos; at += layer.size() + 1)
      xml.insert(at, layer);
  });
}

Outcome run(const std::string& layer, const std::string& name, const std::string& more = {}) {
  return withTestPlugins("run", cubeWith(layer, name), " --lockstep" + more);
}

TEST(SceneWithShading, LoadsItForTheMeshThatSaysSmooth) {
  const std::string scene = test::source("config/scenes/pinch_and_lift.xml");
  const Outcome plain = test::presa("explain " + scene);
  EXPECT_EQ(plain.out.find("presa_shading.so"), std::string::npos) << plain.out;
  const Outcome smooth = test::presa("explain " + scene + " --set body/amphora/haptic/shading=smooth");
  EXPECT_EQ(smooth.status, 0) << smooth.err;
  EXPECT_NE(smooth.out.find("presa_shading.so"), std::string::npos) << smooth.out;
  EXPECT_NE(smooth.out.find("force shading: normals interpolated over the facets"), std::string::npos) << smooth.out;
  const Outcome penalty =
      test::presa("explain " + scene + " --set haptics/renderer=penalty --set body/amphora/haptic/shading=smooth");
  EXPECT_EQ(penalty.out.find("presa_shading.so"), std::string::npos) << penalty.out;
  EXPECT_NE(penalty.out.find("the renderer 'penalty' has no proxy"), std::string::npos) << penalty.out;
}

std::string summaryOf(const Outcome& outcome, const std::string& file) {
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

double number(const std::string& summary, const std::string& name, std::size_t from = 0) {
  const std::size_t at = summary.find("\"" + name + "\":", from);
  return at == std::string::npos ? std::nan("") : std::stod(summary.substr(at + name.size() + 3));
}

// A layer that leaves half of the stiffness is a material of half the stiffness: to the bit, in the fingers and in the
// dynamics, because half is an exact factor.
TEST(SurfaceEffect, OfHalfTheStiffnessIsAMaterialOfHalfTheStiffness) {
  const std::string file = test::scratch("soft.json");
  const std::string layer = summaryOf(run("<test_layer/>", "soft.xml", " --summary " + file), file);
  const std::string halved =
      " --set material/rubber/stiffness=500 --set material/wood/stiffness=1000 --summary " + file;
  const std::string material = summaryOf(run("", "halved.xml", halved), file);
  const auto hash = [](const std::string& summary) { return summary.substr(summary.find("\"state_hash\""), 40); };
  EXPECT_EQ(hash(layer), hash(material));
  EXPECT_NE(hash(layer), hash(summaryOf(run("", "full.xml", " --summary " + file), file)));
}

// What the fingers feel is what the dynamics gives the body: the impulses of the two agree within 1 % over any 0.1 s while
// the fingers squeeze, lift and hold a cube with waves of 0.05 mm, 4 mm long. Steeper waves are outside this (docs/plugins.md).
TEST(SurfaceEffect, ReachesTheDynamicsAsItIsFelt) {
  const std::string file = test::scratch("waves.json");
  const std::string summary = summaryOf(
      run("<test_layer softness=\"1\" height=\"0.00005\"/>", "waves.xml", " --for 8 --summary " + file), file);
  EXPECT_GT(number(summary, "max_normal_force_N"), 4);
  EXPECT_LT(number(summary, "worst", summary.find("impulse_mismatch")), 0.01);
}

TEST(BrokenSurfaceEffect, TakesTheForceToZeroAndIsNamed) {
  for (const auto& [layer, name] : {std::pair("<test_layer fault=\"nan\"/>", "nan_layer.xml"),
                                    std::pair("<test_layer softness=\"1.01\"/>", "stiffer_layer.xml")}) {
    const Outcome outcome = run(layer, name, " --for 3");
    EXPECT_NE(outcome.status, 0) << name;
    EXPECT_NE((outcome.out + outcome.err).find("surface effect <test_layer> of body 'cube'"), std::string::npos)
        << outcome.out << outcome.err;
  }
}

TEST(BrokenSurfaceEffect, ThatCannotBeMadeIsRefusedBeforeAnythingMoves) {
  const Outcome throws = run("<test_layer fault=\"throws\"/>", "throws_layer.xml");
  EXPECT_EQ(throws.status, 2);
  EXPECT_NE(throws.err.find("error[E596]"), std::string::npos) << throws.err;
  EXPECT_NE(throws.err.find("no such layer"), std::string::npos) << throws.err;
}

}  // namespace
}  // namespace presa
