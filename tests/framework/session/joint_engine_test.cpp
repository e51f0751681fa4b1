// Joints and engines that have none.
#include <gtest/gtest.h>

#include <algorithm>

#include "framework/session/load_world.h"

namespace presa {
namespace {

TEST(JointEngine, OneWithoutJointsRefusesThemAtTheFirst) {
  for (const std::string engine : {"bullet", "mujoco"}) {
    Diagnostics findings;
    const std::string scene = std::string(PRESA_SOURCE_DIR) + "/config/scenes/drawer.xml";
    loadWorld({scene, "", {"dynamics/engine=" + engine}}, {}, findings);
    const auto all = findings.all();
    const auto found = std::ranges::find(all, 234, &Diagnostic::code);
    ASSERT_NE(found, all.end()) << engine << findings.text();
    EXPECT_EQ(std::ranges::count(all, 234, &Diagnostic::code), 1) << findings.text();
    EXPECT_NE(found->message.find("the scene has joints, and dynamics_" + engine + " does not"), std::string::npos)
        << findings.text();
    EXPECT_NE(found->help.find("ode"), std::string::npos) << findings.text();
    EXPECT_GT(found->where.line, 1) << findings.text();
  }
}

}  // namespace
}  // namespace presa
