#include <gtest/gtest.h>

#include <regex>

#include "apps/common/file_text.h"
#include "tests/apps/support/support.h"
#include "tests/support/drawn_part.h"

namespace presa {
namespace {

using test::DrawnPart;

TEST(Trail, JoinsThePlacesOfTheLastSeconds) {
  DrawnPart part("<trail length=\"1\"/>");
  EXPECT_TRUE(part.follow(0, {0, 0, 0}).empty());
  EXPECT_EQ(part.follow(0.6, {0.01, 0, 0}).size(), 1U);
  EXPECT_EQ(part.follow(1.0, {0.02, 0, 0}).size(), 2U);
  const auto lines = part.follow(1.2, {0.03, 0, 0});  // 0 s is more than 1 s ago
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].p_WA, Vec3(0.01, 0, 0));
  EXPECT_EQ(lines[1].p_WB, Vec3(0.03, 0, 0));
}

TEST(Trail, HasAnotherColourWhereTheFingertipTouches) {
  DrawnPart part("<trail/>");
  part.follow(0, {0, 0, 0});
  part.follow(0.1, {0.01, 0, 0});
  const auto lines = part.follow(0.2, {0.02, 0, 0}, true);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_NE(lines[0].color, lines[1].color);
}

// A recording may go back; a line across the jump would show a motion that never was.
TEST(Trail, BeginsAnewWhenTimeGoesBack) {
  DrawnPart part("<trail/>");
  part.follow(5, {0, 0, 0});
  part.follow(5.1, {0.01, 0, 0});
  EXPECT_TRUE(part.follow(1, {0.5, 0, 0}).empty());
}

std::string cubeWithTrail() {
  return test::cubeWith("trail.xml", [](std::string& xml) {
    xml.insert(xml.find('>', xml.find("<scene")) + 1, "<trail length=\"5\"/>");
  });
}

TEST(SceneWithTrail, LoadsItOnlyForAPicture) {
  const std::string scene = cubeWithTrail();
  const auto without = test::withTestPlugins("explain", scene);
  EXPECT_EQ(without.status, 0) << without.err;
  EXPECT_EQ(without.out.find("presa_trail.so"), std::string::npos) << without.out;
  EXPECT_TRUE(std::regex_search(without.out, std::regex("\n  trail +no view is wanted\n"))) << without.out;
}

/// Pixels of the file, as bytes.
std::string picture(const std::string& scene, const std::string& name) {
  const std::string file = test::scratch(name);
  const auto run = test::withTestPlugins("run", scene, " --lockstep --for 3 --view offscreen --screenshot " + file);
  EXPECT_EQ(run.status, 0) << run.err;
  return contentsOf(file);
}

TEST(SceneWithTrail, IsDrawn) {
  const std::string with = picture(cubeWithTrail(), "with.png");
  const std::string without = picture(test::cubeWith("plain.xml", [](std::string&) {}), "without.png");
  EXPECT_FALSE(with.empty());
  EXPECT_NE(with, without);
}

}  // namespace
}  // namespace presa
