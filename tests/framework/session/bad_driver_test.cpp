#include <gtest/gtest.h>

#include <cstdlib>

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

}  // namespace
}  // namespace presa
