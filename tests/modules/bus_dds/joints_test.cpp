// The bus carries poses; a viewer knows the scene, so it draws joints as the run itself would.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/modules/bus_dds/viewer_process.h"
#include "tests/support/png_picture.h"

namespace presa::bus {
namespace {

TEST(BusDds, AViewerElsewhereDrawsJoints) {
  const BusSettings bus = ownDomain();
  const std::string base = testing::TempDir() + "/bus_joints_" + std::to_string(getpid());
  std::ofstream(base + ".xml") << R"(<scene version="1.0" name="door"><world gravity="0 0 -9.81"/>
    <materials><material name="wood" stiffness="2000"/></materials>
    <body name="door"><physics mass="1"><box size="0.2 0.02 0.3"/></physics></body>
    <joint name="hinge" type="hinge" body="door" pos="-0.1 0 0"><axis dir="0 0 1" lower_deg="0" upper_deg="90"/></joint>
  </scene>)";
  ViewerProcess run({"run", base + ".xml", "--lockstep", "--speed", "1", "--for", "600", "--view", "none"}, bus);
  for (const bool shown : {false, true}) {
    const std::string picture = base + ".png";
    std::filesystem::remove(picture);
    const std::string part = shown ? "joints" : "visual";
    ViewerProcess viewer({"view", "--join", "--wait", "30", "--for", "0.5", "--view", "offscreen", "--hud", "off",
                          "--background", "white", "--show", part, "--screenshot", picture},
                         bus);
    const std::string said = viewer.rest();
    ASSERT_EQ(viewer.end(), 0) << said;
    if (shown)
      EXPECT_GT(test::violetIn(picture), 200);
    else
      EXPECT_EQ(test::violetIn(picture), 0);
  }
}

}  // namespace
}  // namespace presa::bus
