// Options of pictures on the command line: what is refused, and that each command that draws takes them.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "apps/common/options/view_options.h"
#include "tests/apps/support/support.h"

namespace presa {
namespace {

using test::presa;
using test::scratch;
using test::source;

const std::string kShownCube = source("config/scenes/cube.xml");

/// Width and height in the head of a PNG, and its colour type (6: with alpha).
struct PngHead {
  int width = 0, height = 0, colors = -1;
};
PngHead headOf(const std::string& file) {
  std::array<unsigned char, 26> head{};
  std::ifstream(file, std::ios::binary).read(reinterpret_cast<char*>(head.data()), head.size());
  const auto number = [&](std::size_t at) {
    return head[at] << 24 | head[at + 1] << 16 | head[at + 2] << 8 | head[at + 3];
  };
  return {number(16), number(20), head[25]};
}

// A background without sky is for still pictures off-screen; the reason says which rule is broken.
TEST(PictureOf, RefusesBackgroundsThatCannotBeDrawn) {
  const auto trouble = [](const std::string& background, RunOptions options) {
    Diagnostics diagnostics;
    PictureArguments asked;
    asked.background = background;
    pictureOf(asked, options, diagnostics);
    return diagnostics.text();
  };
  RunOptions still{.view = RunOptions::View::kOffscreen, .screenshot = "a.png"};
  EXPECT_EQ(trouble("transparent", still), "");
  EXPECT_EQ(trouble("white", still), "");
  RunOptions photo = still, window = still, film = still;
  photo.screenshot = "a.jpg";
  window.view = RunOptions::View::kWindow;
  film.video = "a.mp4";
  EXPECT_EQ(trouble("white", photo), "");
  EXPECT_NE(trouble("transparent", photo).find("only a PNG can be transparent"), std::string::npos);
  for (const char* background : {"white", "transparent"}) {
    EXPECT_TRUE(
        trouble(background, window).starts_with("--background: error[E708]: a window always shows floor and sky"));
    EXPECT_TRUE(trouble(background, film).starts_with("--background: error[E708]: a video always shows floor and sky"));
  }
  EXPECT_EQ(trouble("scene", window), "");
}

// All findings at once, in every command, before anything is read or written.
TEST(PictureOptions, AreRefusedBeforeAnythingRuns) {
  const std::string picture = scratch("refused.png");
  const std::string bad = " --camera 1,2 --picture-size 10x10 --screenshot " + picture;
  for (const std::string& command : {"run " + kShownCube + " --lockstep", std::string("replay none.h5"),
                                     std::string("view --join"), std::string("temple")}) {
    const auto outcome = presa(command + bad);
    EXPECT_EQ(outcome.status, 2) << command;
    EXPECT_NE(outcome.err.find("--camera: error[E706]: "), std::string::npos) << command << outcome.err;
    EXPECT_NE(outcome.err.find("--picture-size: error[E707]: "), std::string::npos) << command << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(picture));
  }
  EXPECT_NE(presa("run " + kShownCube + " --hud some").status, 0);
  EXPECT_NE(presa("run " + kShownCube + " --background black").status, 0);
}

// A run and the replay of its recording draw the same still from the same camera: the moment is the same to the bit.
TEST(PictureOptions, RunAndReplayTakeTheSame) {
  const std::string record = scratch("paper.h5"), first = scratch("run.png"), second = scratch("replay.png");
  const std::string same =
      " --view offscreen --camera iso --picture-size 320x200 --hud minimal --legend --background transparent "
      "--screenshot ";
  const auto run = presa("run " + kShownCube + " --lockstep --for 0.3 --quiet --record " + record + same + first);
  ASSERT_EQ(run.status, 0) << run.err;
  const auto replay = presa("replay " + record + same + second);
  ASSERT_EQ(replay.status, 0) << replay.err;
  for (const std::string& file : {first, second}) {
    EXPECT_EQ(headOf(file).width, 320) << file;
    EXPECT_EQ(headOf(file).height, 200) << file;
    EXPECT_EQ(headOf(file).colors, 6) << file;
  }
}

}  // namespace
}  // namespace presa
