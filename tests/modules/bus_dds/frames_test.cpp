// A viewer elsewhere shows the frames of the run's rig, of which it has no file, and says what happens to them.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/modules/bus_dds/viewer_process.h"
#include "tests/support/png_picture.h"

namespace presa::bus {
namespace {

/// Pixels of the red axes of coordinate frames.
int redIn(const std::string& file) {
  const test::PngPicture picture(file);
  int red = 0;
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      const test::Color c = picture.at(x, y);
      red += c.r > 90 && c.r > 3 * c.g && c.r > 3 * c.b ? 1 : 0;
    }
  return red;
}

// The desk moves by itself for as long as the run lasts, too slowly to leave the picture.
TEST(BusDds, AViewerElsewhereShowsTheFramesOfTheRig) {
  const std::string base = testing::TempDir() + "/bus_frames_" + std::to_string(getpid());
  std::ofstream(base + ".csv") << "time_s,role,x_m,y_m,z_m\n0,thumb,-0.05,0,0\n600,thumb,-0.05,0,0\n"
                                  "0,index,0.15,0,0.15\n600,index,0.15,0,0.15\n";
  const auto rig = [&](const std::string& frame, const std::string& in, const std::string& z) {
    const std::string motion = "><set key=\"motion\" value=\"" + base + ".csv\"/></device>";
    const std::string file = base + z + ".xml";
    std::ofstream(file) << "<rig version=\"1.0\" name=\"r\">" << frame << "<device role=\"thumb\" driver=\"scripted\""
                        << in << motion << "<device role=\"index\" driver=\"scripted\"" << motion << "</rig>";
    return file;
  };
  const std::string moving = "<frame name=\"desk\" pos=\"-0.1 0 0.12\" velocity=\"0 0 0.0001\"/>";
  std::vector<int> red;
  for (const bool framed : {false, true}) {
    const BusSettings bus = ownDomain();
    const std::string file = framed ? rig(moving, " in=\"desk\"", "_framed") : rig("", "", "_bare");
    ViewerProcess run({"run", kCube, "--rig", file, "--lockstep", "--speed", "1", "--for", "600", "--view", "none"},
                      bus);
    const std::string picture = base + ".png";
    std::filesystem::remove(picture);
    ViewerProcess viewer({"view", "--join", "--wait", "30", "--for", "2", "--view", "offscreen", "--hud", "off",
                          "--background", "white", "--show", "frames,no-visual", "--screenshot", picture},
                         bus);
    const std::string said = viewer.rest();
    ASSERT_EQ(viewer.end(), 0) << said;
    EXPECT_EQ(said.find("'desk' moves.") != std::string::npos, framed) << said;
    red.push_back(redIn(picture));
  }
  EXPECT_GT(red[1], red[0] + 50) << "axes of the world and of bodies are in both";
}

}  // namespace
}  // namespace presa::bus
