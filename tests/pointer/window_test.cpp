// The program with a real window under an X server of its own: events that come through it grasp and lift.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <tuple>

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
later() { picture; until=$(awk "BEGIN{print $time + $1}"); while awk "BEGIN{exit !($time < $until)}"; do picture; done; }
keys() { xdotool key --delay 20 $(yes $2 | head -$1); }
wheel() { xdotool click --repeat $1 --delay 30 $2; }
drag() {  # pixels right and down, in ten steps, with whatever keys are down
  xdotool mousemove 680 440 mousedown 1
  for i in $(seq 10); do xdotool mousemove_relative --sync -- $(($1 / 10)) $(($2 / 10)); done
  xdotool mouseup 1
}
)";

std::string contentsOf(const std::string& file) {
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

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

}  // namespace
}  // namespace presa
