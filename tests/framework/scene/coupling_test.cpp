// The coupling of scenes that state none: at the haptic rate only where forces change within a step of the dynamics and
// the haptic thread can move the bodies.
#include <gtest/gtest.h>

#include "tests/framework/scene/scene_text.h"

namespace presa::scene_test {
namespace {

using Coupling = DynamicsSettings::Coupling;

constexpr const char* kRidges = R"(<texture shape="sine" amplitude="0.0001" wavelength="0.002"/>)";

/// kScene with ridges on the free cube.
std::string ridged() {
  return edited(kScene, R"(damping="1" color="0.75 0.25 0.2">)", R"(damping="1">)" + std::string(kRidges));
}

Scene loadedScene(const std::string& text, const std::vector<Override>& overrides = {}) {
  Diagnostics findings;
  Scene scene = parseScene(text, "scene.xml", "/lab", overrides, findings);
  EXPECT_FALSE(findings.hasErrors()) << findings.text();
  return scene;
}

void expectSoft(const std::string& text, const char* why) {
  const Scene scene = loadedScene(text);
  EXPECT_EQ(scene.dynamics.coupling, Coupling::kSoft) << why;
  EXPECT_EQ(scene.dynamics.coupling_reason, "") << why;
}

TEST(CouplingOfASceneThatStatesNone, IsAtTheHapticRateWhereForcesChangeWithinAStep) {
  const Scene scene = loadedScene(ridged());
  EXPECT_EQ(scene.dynamics.coupling, Coupling::kHapticRate);
  EXPECT_EQ(scene.dynamics.coupling_reason, "<texture> changes the force on 'cube' within a step of the dynamics");
  EXPECT_NE(scene.resolved_xml.find("coupling=\"haptic_rate\""), std::string::npos) << scene.resolved_xml;
}

/// The reason for the haptic rate, or "".
std::string reasonWith(const char* path, const char* value, const char* dynamics_rate = "200") {
  return loadedScene(kScene, {{.path = path, .value = value}, {.path = "rates/dynamics", .value = dynamics_rate}})
      .dynamics.coupling_reason;
}

TEST(CouplingOfASceneThatStatesNone, IsAtTheHapticRateOnAStiffSurface) {
  const char* const path = "material/rubber/stiffness";
  EXPECT_EQ(reasonWith(path, "4000"),
            "a finger at 50 mm/s changes the force on 'cube' by 1 N within a step of the dynamics");
  EXPECT_EQ(reasonWith(path, "3100"), "");
  EXPECT_NE(reasonWith(path, "1700", "100"), "") << "a step of twice the length";
  EXPECT_EQ(reasonWith(path, "4000", "500"), "");
  EXPECT_EQ(reasonWith("material/wood/stiffness", "20000"), "") << "of a fixed body";
}

TEST(CouplingOfASceneThatStatesNone, IsAtTheHapticRateForAQuickSpin) {
  const char* const path = "body/cube/angular_velocity";
  EXPECT_EQ(reasonWith(path, "0 30 0"), "'cube' turns by 0.15 rad within a step of the dynamics");
  EXPECT_EQ(reasonWith(path, "0 10 0"), "");
  EXPECT_EQ(reasonWith(path, "0 60 0"), "") << "too quick for the haptic thread";
}

TEST(CouplingOfASceneThatStatesNone, IsSoftWhereNothingCallsForMore) {
  expectSoft(kScene, "no element changes a force");
  expectSoft(edited(kScene, R"(<material name="wood" stiffness="2000"/>)",
                    R"(<material name="wood" stiffness="2000">)" + std::string(kRidges) + "</material>"),
             "ridges on a fixed body");
}

TEST(CouplingOfASceneThatStatesNone, IsSoftWhereTheHapticThreadCannotMoveTheBody) {
  expectSoft(edited(ridged(), "mass=\"0.2\"", "mass=\"0.0009\""), "1000 N/m are too stiff for 0.9 g at 1000 Hz");
  expectSoft(edited(ridged(), R"(<cylinder radius="0.03" length="0.07"/>)", R"(<mesh file="meshes/cube.obj"/>)"),
             "a physics mesh, which ODE may collide");
  expectSoft(edited(ridged(), "<body name=\"table\"", "<dynamics solver=\"direct\"/><body name=\"table\""),
             "a solver of the engine");
}

TEST(CouplingOfASceneThatStatesNone, IsNotThatOfASceneThatStatesOne) {
  const std::string stated =
      edited(ridged(), "<body name=\"table\"", "<dynamics coupling=\"soft\"/><body name=\"table\"");
  EXPECT_EQ(loadedScene(stated).dynamics.coupling, Coupling::kSoft);
  EXPECT_EQ(loadedScene(ridged(), {{.path = "dynamics/coupling", .value = "soft"}}).dynamics.coupling, Coupling::kSoft);
}

// A copy, as recordings hold it, states the coupling that was chosen.
TEST(CouplingOfASceneThatStatesNone, IsThatOfItsCopy) {
  const Scene copy = loadedScene(loadedScene(ridged()).resolved_xml);
  EXPECT_EQ(copy.dynamics.coupling, Coupling::kHapticRate);
  EXPECT_EQ(copy.dynamics.coupling_reason, "");
}

}  // namespace
}  // namespace presa::scene_test
