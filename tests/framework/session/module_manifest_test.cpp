#include <gtest/gtest.h>

#include <cstdlib>

#include "framework/session/run.h"

// When a run needs a module: its manifest says it, and the plan names no plug-in.
namespace presa {
namespace {

std::string sceneWith(const std::string& elements) {
  return R"(<scene version="1.0" name="any"><world gravity="0 0 0"/>
    <materials><material name="any" stiffness="1000"/></materials>)" +
         elements + R"(<body name="block" fixed="true"><physics><box size="0.1 0.1 0.1"/></physics></body></scene>)";
}

class ModuleManifest : public testing::Test {
 protected:
  void SetUp() override { setenv("PRESA_PLUGIN_PATH", PRESA_BINARY_DIR "/tests/plugins", 1); }
  static Loaded load(const std::string& elements) {
    Diagnostics diagnostics;
    Loaded loaded =
        loadWithoutDevices({.scene_xml = sceneWith(elements), .name = "scene.xml", .rig_xml = {}}, {}, diagnostics);
    if (diagnostics.hasErrors()) throw InputError(std::move(diagnostics));
    return loaded;
  }
};

TEST_F(ModuleManifest, WithAnElementIsNeededWhereItStands) {
  EXPECT_TRUE(load("<misplaced/>").plan.has("misplaced"));
  EXPECT_FALSE(load("").plan.has("misplaced"));
}

TEST_F(ModuleManifest, OfAnEngineIsNeededForAFreeBodyOfThatEngine) {
  const std::string free = R"(<body name="ball"><physics mass="1"><sphere radius="0.1"/></physics></body>)";
  EXPECT_FALSE(load("").plan.has("dynamics_ode"));
  EXPECT_TRUE(load(free).plan.has("dynamics_ode"));
  const Plan bullet = load(R"(<dynamics engine="bullet"/>)" + free).plan;
  EXPECT_TRUE(bullet.has("dynamics_bullet"));
  EXPECT_FALSE(bullet.has("dynamics_ode"));
}

// Its steps would run on another thread than the user was told.
TEST_F(ModuleManifest, OfAnotherRateThanTheLibraryIsRefused) {
  RunControl control;
  try {
    const presa::Run run(load("<misplaced/>"), control);
    FAIL() << "not refused";
  } catch (const InputError& error) {
    ASSERT_EQ(error.diagnostics().errorCount(), 1U);
    EXPECT_EQ(error.diagnostics().all()[0].code, 596);
    EXPECT_EQ(error.diagnostics().all()[0].message,
              "the library of module 'misplaced' makes a module of the haptic rate, its manifest says rate=\"view\"");
  }
}

}  // namespace
}  // namespace presa
