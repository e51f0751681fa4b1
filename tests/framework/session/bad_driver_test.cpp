#include <gtest/gtest.h>

#include <cstdlib>

#include "framework/scene/manifest.h"
#include "framework/session/load_world.h"

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
