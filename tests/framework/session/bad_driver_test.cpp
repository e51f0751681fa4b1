#include <gtest/gtest.h>

#include <cstdlib>

#include "framework/scene/load.h"
#include "framework/scene/manifest.h"
#include "framework/session/load_world.h"
#include "framework/session/session.h"

namespace presa {
namespace {

constexpr const char* kTwoFingers = R"(<scene version="1.0" name="touch">
  <world gravity="0 0 0"/><materials><material name="soft" stiffness="500"/></materials>
  <body name="block" fixed="true"><haptic><box size="0.1 0.1 0.1"/></haptic></body>
  <devices><device role="thumb"/><device role="index"/></devices>
</scene>)";

constexpr const char* kForgetfulRig = R"(<rig version="1.0" name="bad">
  <device role="thumb" driver="forgetful"/>
  <device role="index" driver="forgetful"/>
</rig>)";

// Otherwise a run would begin with fewer fingers than its scene has.
TEST(BadDriver, ThatMakesTooFewDevicesIsRefusedAtEachRole) {
  setenv("PRESA_PLUGIN_PATH", PRESA_BINARY_DIR "/tests/plugins", 1);
  Diagnostics diagnostics;
  loadWorldFromText({.scene_xml = kTwoFingers, .name = "scene.xml", .rig_xml = kForgetfulRig}, {}, diagnostics);
  std::vector<std::string> messages;
  for (const Diagnostic& one : diagnostics.all()) messages.push_back(one.message);
  ASSERT_EQ(messages.size(), 2U) << (messages.empty() ? "none" : messages[0]);
  EXPECT_EQ(messages[0], "role 'thumb': driver 'forgetful' made 0 devices for 2 roles");
  EXPECT_EQ(messages[1], "role 'index': driver 'forgetful' made 0 devices for 2 roles");
}

/// Findings about the limits of an impatient thumb, whose rating is a watchdog of 20 ms, beside a body that moves.
std::string findingsAtDynamics(int rate, const std::string& body) {
  const std::string scene = R"(<scene version="1.0" name="touch"><world gravity="0 0 0"/>
    <rates dynamics=")" + std::to_string(rate) +
                            R"("/><materials><material name="soft" stiffness="500"/></materials>
    )" + body + R"(
    <devices><device role="thumb"/></devices></scene>)";
  Diagnostics diagnostics;
  World world;
  world.scene = parseScene(scene, "scene.xml", ".", {}, diagnostics);
  world.rig = parseRig(R"(<rig version="1.0" name="any"><device role="thumb" driver="impatient"/></rig>)", "rig.xml",
                       ".", diagnostics);
  std::vector<std::string> notes;
  safetyOf(world, {}, notes, diagnostics);
  return diagnostics.text();
}

// Two periods of the dynamics are 20 ms at 100 Hz. At 50 Hz the force would fade although everything is on time, and no
// value of the scene can help. Without a body that moves there is no dynamics to wait for.
TEST(BadDriver, WhoseWatchdogIsTooShortForTheDynamicsIsRefused) {
  setenv("PRESA_PLUGIN_PATH", PRESA_BINARY_DIR "/tests/plugins", 1);
  const std::string moves = R"(<body name="b"><haptic><sphere radius="0.1"/></haptic>
    <physics mass="1"><sphere radius="0.1"/></physics></body>)";
  const std::string stands = R"(<body name="b" fixed="true"><haptic><sphere radius="0.1"/></haptic></body>)";
  EXPECT_EQ(findingsAtDynamics(200, moves), "");
  EXPECT_EQ(findingsAtDynamics(100, moves), "");
  const std::string found = findingsAtDynamics(50, moves);
  EXPECT_NE(found.find("scene.xml:5:14: error[E656]: the force of 'thumb' would fade although the dynamics is on time: "
                       "its driver is rated for a watchdog of 20 ms, found dynamics at 50 Hz"),
            std::string::npos)
      << found;
  EXPECT_NE(found.find("rates/dynamics=\"100\" or more"), std::string::npos) << found;
  EXPECT_EQ(findingsAtDynamics(50, stands).find("E656"), std::string::npos);
}

/// Findings about a rig in which this driver plays the thumb.
std::string findingsOf(const std::string& driver, const std::string& setting) {
  const std::string scene = R"(<scene version="1.0" name="touch">
    <world gravity="0 0 0"/><materials><material name="soft" stiffness="500"/></materials>
    <body name="block" material="soft"><haptic><box size="0.1 0.1 0.1"/></haptic>
      <physics mass="0.1"><box size="0.1 0.1 0.1"/></physics></body>
    <devices><device role="thumb"/></devices></scene>)";
  const std::string rig = "<rig version=\"1.0\" name=\"any\"><device role=\"thumb\" driver=\"" + driver +
                          "\"><set key=\"" + setting + "\" value=\"1\"/></device></rig>";
  Diagnostics diagnostics;
  loadWorldFromText({.scene_xml = scene, .name = "scene.xml", .rig_xml = rig}, {}, diagnostics);
  return diagnostics.text();
}

// The manifest lists the settings, so that a misspelt one is refused for every driver, and no driver has to do it.
TEST(BadRig, ASettingThatNoManifestListsIsRefusedForEveryDriver) {
  int drivers = 0;
  for (const Manifest& manifest : manifests()) {
    if (manifest.kind != PluginKind::kDevice || manifest.settings.empty()) continue;
    ++drivers;
    const std::string meant = manifest.settings.front().name;
    const std::string found = findingsOf(manifest.name, meant + "x");
    EXPECT_NE(found.find("E401"), std::string::npos) << found;
    EXPECT_NE(
        found.find("driver '" + manifest.name + "' has no setting '" + meant + "x' (did you mean '" + meant + "'?)"),
        std::string::npos)
        << found;
  }
  EXPECT_GE(drivers, 9);
}

TEST(BadRig, AMisspeltDriverIsAskedFor) {
  const std::string found = findingsOf("scriptd", "motion");
  EXPECT_NE(found.find("driver 'scriptd' cannot be loaded (did you mean 'scripted'?)"), std::string::npos) << found;
}

}  // namespace
}  // namespace presa
