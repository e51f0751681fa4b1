// The program with a real window on its own X server: grasping and lifting by X events.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <tuple>

#include "apps/common/file_text.h"
#include "apps/common/scratch_folder.h"
#include "apps/temple/building/building.h"
#include "apps/temple/building/proportions.h"
#include "apps/temple/written_scene.h"

namespace presa {
namespace {

const std::string kProgram = std::string(PRESA_BINARY_DIR) + "/bin/presa";
const std::string kRig = PRESA_SOURCE_DIR "/config/rigs/pointer_pair.xml";

// The screenshots saved by the key s are named by simulated time. They show that the window responds, and that enough
// simulated time has passed for the hand to arrive. No test waits for wall-clock time except between queries.
constexpr const char* kHelpers = R"(
picture() {
  rm -f presa-*.png
  for i in $(seq 300); do
    kill -0 $run || exit 1
    xdotool key s; sleep 0.4
    for file in presa-*.png; do
      [ -e "$file" ] && { file=${file%s.png}; time=${file##*-}; return; }
    done
  done
  echo "the window does not answer"; kill $run; exit 1
}
# the picture under way, one asked for meanwhile, and the frame that takes the events, may still show the time before them
later() { picture; picture; picture; until=$(awk "BEGIN{print $time + $1}"); while awk "BEGIN{exit !($time < $until)}"; do picture; done; }
keys() { xdotool key --delay 20 $(yes $2 | head -$1); }
wheel() { xdotool click --repeat $1 --delay 30 $2; }
drag() {  # pixels right and down, in ten steps, with whatever keys are down
  xdotool mousemove 680 440 mousedown 1
  for i in $(seq 10); do xdotool mousemove_relative --sync -- $(($1 / 10)) $(($2 / 10)); done
  xdotool mouseup 1
}
)";

/// A run with a window, controlled by the lines of `script` and stopped by Esc. `folder` receives its summary and
/// recording.
void runWith(const std::string& scene, const std::string& script, const ScratchFolder& folder) {
  std::ofstream(folder.file("user.sh"))
      << "cd " << folder.path().string() << "\n"
      << kProgram << " run " << scene << " --rig " << kRig << " --view window --realtime --for 3600 --quiet --summary "
      << folder.file("summary.json") << " --record " << folder.file("run.h5") << " &\n"
      << "run=$!\n"
      << kHelpers << "timeout 60 xdotool search --sync --onlyvisible --name Presa\nxdotool mousemove 680 440\npicture\n"
      << script << "xdotool key Escape\nwait $run; echo $? > " << folder.file("status") << "\n";
  // xvfb-run's own status also reports failed clean-ups
  std::ignore = std::system(("timeout 280 xvfb-run -a -s '-screen 0 1400x900x24' bash " + folder.file("user.sh") +
                             " > " + folder.file("log") + " 2>&1")
                                .c_str());
  EXPECT_EQ(contentsOf(folder.file("status")), "0\n") << contentsOf(folder.file("log"));
}

// Moved down to the cube by keys, closed by the wheel, lifted by the mouse. The summary counts the grasp and the lift
// height; the recording gives the same forces without window and mouse.
TEST(PointerWindow, MouseAndKeysGraspAndLiftTheCube) {
  const ScratchFolder folder;
  runWith(PRESA_SOURCE_DIR "/config/scenes/cube.xml",
          "keys 21 Page_Down\nlater 1.5\n"
          "wheel 20 4\nlater 2\n"
          "xdotool keydown shift; drag 0 -150; xdotool keyup shift\nlater 2\n",
          folder);
  const auto summary = nlohmann::json::parse(contentsOf(folder.file("summary.json")));
  const auto& cube = summary.at("objects").at(0);
  EXPECT_TRUE(cube.at("grasped"));
  EXPECT_FALSE(cube.at("dropped"));
  EXPECT_GT(cube.at("final_position_m").at(2).get<double>(), cube.at("start_position_m").at(2).get<double>() + 0.03);
  const int verified = std::system(
      (kProgram + " replay " + folder.file("run.h5") + " --verify > " + folder.file("verified") + " 2>&1").c_str());
  EXPECT_EQ(WEXITSTATUS(verified), 0) << contentsOf(folder.file("verified"));
}

/// Key presses for a distance [m]; each moves the pair by one step of 5 mm.
std::string keys(double way, const std::string& key) {
  return "keys " + std::to_string(std::lround(way / 0.005)) + " " + key + "\n";
}

// The lowest drum of the temple's column stands 0.2 m to the left of its goal as seen by the camera, which is 12
// degrees right of the front. It is grasped, lifted, carried over its goal and lowered to within 10 mm; the goal
// attracts it, and the summary counts it.
TEST(PointerWindow, ATempleDrumCarriedToItsPlaceIsCounted) {
  const ScratchFolder folder;
  Diagnostics diagnostics;
  temple::Building column = temple::makeBuilding(temple::shippedProportions("column", diagnostics), 0.1, 1);
  ASSERT_EQ(diagnostics.text(), "");
  column.blocks.resize(1);
  const temple::Block& drum = column.blocks.front();
  const Cylinder& shape = std::get<Cylinder>(drum.physics);
  const Vec3 place = drum.X_WB.p,
             way(0.2 * std::cos(12 * std::numbers::pi / 180), 0.2 * std::sin(12 * std::numbers::pi / 180), 0);
  temple::SceneSpec spec = temple::assembled(column);
  spec.to_be_built = true;
  spec.stones.front().X_WB.p = place - way;
  spec.stones.front().X_WB.p.z() = shape.length / 2;
  spec.rig = kRig;
  // the pair starts 0.15 m above the ground and grasps the drum slightly above its middle
  const double down = 0.15 - shape.length / 2 - 0.008, rise = place.z() - shape.length / 2 + 0.03;
  runWith(temple::writeScene(column, spec, folder.file("drum")),
          keys(down, "Page_Down") + "later 1.5\nwheel 20 4\nlater 2\n" + keys(rise, "Page_Up") + "later 1\n" +
              keys(0.2, "Right") + "later 1.5\n" + keys(0.025, "Page_Down") + "later 1\nwheel 20 5\nlater 3\n",
          folder);
  const auto summary = nlohmann::json::parse(contentsOf(folder.file("summary.json")));
  EXPECT_EQ(summary.at("assembly").dump(), R"({"filled":1,"goals":1})") << summary.at("objects").dump();
  const auto& carried = summary.at("objects").at(0);
  EXPECT_TRUE(carried.at("grasped"));
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(carried.at("final_position_m").at(static_cast<std::size_t>(axis)).get<double>(), place[axis],
                0.0005);  // tolerance
}

}  // namespace
}  // namespace presa
