// The program with a real window under an X server of its own: events that come through it grasp and lift.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <tuple>

#include "apps/common/file_text.h"
#include "apps/common/scratch_folder.h"
#include "apps/temple/written_scene.h"
#include "apps/temple/building/building.h"
#include "apps/temple/building/proportions.h"

namespace presa {
namespace {

const std::string kProgram = std::string(PRESA_BINARY_DIR) + "/bin/presa";
const std::string kRig = PRESA_SOURCE_DIR "/config/rigs/pointer_pair.xml";

// The pictures that the key s saves are named by simulated time: they tell when the window answers, and when so much time has gone by
// for the hand to arrive. Nothing here waits for a clock of the machine but to ask again.
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

/// A run with a window, moved by the lines of `script`, stopped by Esc. `folder` has its summary and its recording.
void runWith(const std::string& scene, const std::string& script, const ScratchFolder& folder) {
  std::ofstream(folder.file("user.sh"))
      << "cd " << folder.path().string() << "\n"
      << kProgram << " run " << scene << " --rig " << kRig << " --view window --realtime --for 3600 --quiet --summary "
      << folder.file("summary.json") << " --record " << folder.file("run.h5") << " &\n"
      << "run=$!\n"
      << kHelpers << "timeout 60 xdotool search --sync --onlyvisible --name Presa\nxdotool mousemove 680 440\npicture\n"
      << script << "xdotool key Escape\nwait $run; echo $? > " << folder.file("status") << "\n";
  // xvfb-run's own status also tells of what it could not clean up
  std::ignore = std::system(("timeout 280 xvfb-run -a -s '-screen 0 1400x900x24' bash " + folder.file("user.sh") +
                             " > " + folder.file("log") + " 2>&1")
                                .c_str());
  EXPECT_EQ(contentsOf(folder.file("status")), "0\n") << contentsOf(folder.file("log"));
}

// By keys down to the cube, closed by the wheel, lifted by the mouse. The summary counts the grasp and how high it went; the
// recording gives the same forces without window and mouse.
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

/// `count` presses of a key, a step of the pair each.
std::string keys(double way, const std::string& key) {
  return "keys " + std::to_string(std::lround(way / 0.005)) + " " + key + "\n";
}

// The lowest drum of the temple's column stands on the ground, 0.2 m to the left of its place as the camera sees it, 12 degrees right of
// the front. It is taken, lifted, carried over its place and let down to within 10 mm: the place draws it, and the summary counts it.
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
  // the pair begins 0.15 m over the ground, and takes the drum a little above its middle
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
