// A small picture of each scene of config/scenes, as the programs draw it today, against the one of config/pictures/scenes.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "tests/apps/support/support.h"
#include "tests/pictures/scenes.h"
#include "tests/pictures/seen_difference.h"
#include "tests/support/png_picture.h"

namespace presa {
namespace {

using test::Color;
using test::PngPicture;
using test::SeenDifference;
using test::source;

constexpr double kSeen = 2 * SeenDifference::kJustNoticeable;

/// Pixels that a person sees change. Bound: Mesa's two software rasterisers (llvmpipe and softpipe), which round edges,
/// textures and blending in their own ways, differ so in one pixel at most of any of these pictures (and by one just
/// noticeable difference in up to 148). The smallest fault of the tests below, a cup 5 mm beside its place, in 183; shaders
/// without shadows in 37 (a flat board) to 3083 (the lifted cube).
constexpr int kPixels = 8;

std::string committed(const std::string& scene) { return source("config/pictures/scenes/" + scene + ".png"); }

std::string drawn(const std::string& scene, const std::string& arguments = {}) {
  const std::string folder = test::scratch("scene_pictures");
  std::filesystem::create_directories(folder);
  const auto run = test::shell(source("tests/pictures/draw.sh") + " scene " PRESA_BINARY_DIR "/bin " + folder + " " +
                               scene + " " + arguments);
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  return folder + "/scenes/" + scene + ".png";
}

class ScenePicture : public testing::TestWithParam<std::string> {};

TEST_P(ScenePicture, IsAsItIsDrawnToday) {
  const PngPicture was(committed(GetParam())), is(drawn(GetParam()));
  const std::string remedy = GetParam() + " has changed: ./dev pictures scenes/" + GetParam();
  ASSERT_EQ(is.width(), was.width()) << remedy;
  ASSERT_EQ(is.height(), was.height()) << remedy;
  const SeenDifference difference(is, was);
  EXPECT_LE(difference.above(kSeen), kPixels) << remedy << "; largest difference " << difference.max();
}

INSTANTIATE_TEST_SUITE_P(Shipped, ScenePicture, testing::ValuesIn(test::shippedScenes()),
                         [](const auto& scene) { return scene.param; });

TEST(ScenePictures, BelongToAScene) {
  const std::vector<std::string> scenes = test::shippedScenes();
  std::set<std::string> pictures;
  for (const auto& entry : std::filesystem::directory_iterator(source("config/pictures/scenes")))
    pictures.insert(entry.path().stem().string());
  EXPECT_EQ(pictures, std::set<std::string>(scenes.begin(), scenes.end())) << "./dev pictures scenes";
}

// The smallest body that is a few millimetres beside its place is seen: a cup of the tea tray.
TEST(ScenePictures, ShowABodyThatIsFiveMillimetresBesideItsPlace) {
  const PngPicture was(committed("tea_tray")), is(drawn("tea_tray", "--set 'body/cup_left/pos=-0.1 0.015 0.095'"));
  EXPECT_GT(SeenDifference(is, was).above(kSeen), 10 * kPixels);
}

/// The lifted cube without its shadow on the table: what is darker than lit wood there has the colour of the wood.
struct WithoutShadow {
  const PngPicture& picture;
  int width() const { return picture.width(); }
  int height() const { return picture.height(); }
  Color at(int x, int y) const {
    const Color c = picture.at(x, y);
    const bool shaded = x >= 84 && x < 164 && y >= 132 && c.r < 130;
    return shaded ? Color{207, 180, 150} : c;
  }
};

TEST(ScenePictures, ShowAMissingShadow) {
  const PngPicture was(committed("cube"));
  EXPECT_GT(SeenDifference(WithoutShadow{was}, was).above(kSeen), 100 * kPixels);
}

}  // namespace
}  // namespace presa
