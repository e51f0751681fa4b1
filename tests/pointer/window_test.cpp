// The program with a real window under an X server of its own: events that come through it grasp and lift.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <tuple>

#include "apps/presa/file_text.h"
#include "apps/presa/scratch_folder.h"

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

// A block of 40 x 40 x 60 mm is taken from the table, carried 0.2 m to the right of the picture, which the camera sees from 12 degrees
// right of the front, and set down 6 mm beside its place: the place draws it, and the summary counts it.
TEST(PointerWindow, ABlockCarriedToItsPlaceIsCounted) {
  const ScratchFolder folder;
  const double x = -0.1 + 0.2 * std::cos(12 * std::numbers::pi / 180) - 0.006,
               y = 0.2 * std::sin(12 * std::numbers::pi / 180);
  std::ofstream(folder.file("block.xml")) << R"(<scene version="1.0" name="cube"><world gravity="0 0 -9.81"/>
  <materials><material name="stone" stiffness="1000" damping="1"><friction static="0.8" dynamic="0.7" torsion="0.004"/></material></materials>
  <body name="table" fixed="true" pos="0 0 -0.05"><haptic><box size="2 2 0.1"/></haptic><physics><box size="2 2 0.1"/></physics></body>
  <body name="block" pos="-0.1 0 0.03"><haptic><box size="0.04 0.04 0.06"/></haptic>
    <physics mass="0.1"><box size="0.04 0.04 0.06"/></physics></body>
  <devices><device role="thumb"/><device role="index"/></devices>
  <assembly><goal name="place" bodies="block" pos=")"
                                          << x << " " << y << R"( 0.03" fold="4"/></assembly></scene>)";
  runWith(folder.file("block.xml"),
          "keys 22 Page_Down\nlater 1.5\n"
          "wheel 20 4\nlater 2\n"
          "keys 10 Page_Up\nlater 1\nkeys 40 Right\nlater 1.5\nkeys 10 Page_Down\nlater 1\n"
          "wheel 20 5\nlater 3\n",
          folder);
  const auto summary = nlohmann::json::parse(contentsOf(folder.file("summary.json")));
  EXPECT_EQ(summary.at("assembly").dump(), R"({"filled":1,"goals":1})") << summary.at("objects").dump();
  const auto& block = summary.at("objects").at(0);
  EXPECT_TRUE(block.at("grasped"));
  EXPECT_NEAR(block.at("final_position_m").at(0).get<double>(), x, 0.0005);  // the place's tolerance
  EXPECT_NEAR(block.at("final_position_m").at(1).get<double>(), y, 0.0005);
}

}  // namespace
}  // namespace presa
