#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/walls/walls.h"

namespace presa::walls {
namespace {

using testing::HasSubstr;

const std::string kRoom = R"(<walls version="1.0" name="room" magnification="2" pos="1 2 3">
  <head pos="0 -1 1.7"/>
  <wall name="front" lower_left="-1.5 1.5 0" lower_right="1.5 1.5 0" upper_left="-1.5 1.5 2.25" width="640" height="480"/>
</walls>
)";

std::string findings(const std::string& xml) {
  Diagnostics diagnostics;
  parseWalls(xml, "room.xml", diagnostics);
  return diagnostics.text();
}

std::string with(const std::string& from, const std::string& to) {
  std::string text = kRoom;
  const std::size_t at = text.find(from);
  if (at == text.npos) throw std::logic_error("not there: " + from);
  return text.replace(at, from.size(), to);
}

TEST(WallsFile, IsRead) {
  Diagnostics diagnostics;
  const Walls walls = parseWalls(kRoom, "room.xml", diagnostics);
  ASSERT_EQ(diagnostics.text(), "");
  EXPECT_EQ(walls.name, "room");
  EXPECT_EQ(walls.magnification, 2);
  EXPECT_EQ(walls.eye_distance, 0.064);
  EXPECT_EQ(walls.X_WK.p, Vec3(1, 2, 3));
  EXPECT_EQ(walls.X_KHead.p, Vec3(0, -1, 1.7));
  const Wall& front = walls.wall("front");
  EXPECT_EQ(front.lower_left, Vec3(-1.5, 1.5, 0));
  EXPECT_EQ(front.lower_right, Vec3(1.5, 1.5, 0));
  EXPECT_EQ(front.upper_left, Vec3(-1.5, 1.5, 2.25));
  EXPECT_EQ(front.width, 640);
  EXPECT_EQ(front.height, 480);
  EXPECT_EQ(front.where.line, 3);
}

TEST(WallsFile, AWallWithoutAreaIsRefused) {
  for (const char* to : {"lower_right=\"-1.5 1.5 0\"", "lower_right=\"-1.5 1.5 1\""})
    EXPECT_THAT(findings(with("lower_right=\"1.5 1.5 0\"", to)),
                HasSubstr("room.xml:3:3: error[E760]: wall 'front' has no area"))
        << to;
}

TEST(WallsFile, AWallThatIsNoRectangleIsRefused) {
  const std::string found = findings(with("upper_left=\"-1.5", "upper_left=\"-1.4"));
  EXPECT_THAT(found, HasSubstr("room.xml:3:3: error[E761]: wall 'front' is no rectangle"));
  EXPECT_THAT(found, HasSubstr("0.1 m off"));
  EXPECT_EQ(findings(with("upper_left=\"-1.5", "upper_left=\"-1.499")), "");  // 0.4 mm on a metre
}

TEST(WallsFile, AnEyeBehindAWallIsRefused) {
  EXPECT_THAT(findings(with("pos=\"0 -1 1.7\"", "pos=\"0 1.6 1.7\"")),
              HasSubstr("room.xml:3:3: error[E762]: an eye of <head> is behind wall 'front'"));
  // the head before the wall, one eye behind it: the head looks along the wall, its right eye towards it
  EXPECT_THAT(findings(with("pos=\"0 -1 1.7\"", "pos=\"0 1.47 1.7\" euler_deg=\"0 0 90\"")), HasSubstr("E762"));
}

TEST(WallsFile, OtherMistakesAreFoundWhereTheyAre) {
  EXPECT_THAT(findings(with("width=\"640\"", "width=\"641\"")),
              testing::AllOf(HasSubstr("room.xml:3:"), HasSubstr("an even number from 64 to 8192")));
  EXPECT_THAT(findings(with("  <head pos=\"0 -1 1.7\"/>\n", "")), HasSubstr("room.xml:1:1: error[E113]"));
  EXPECT_THAT(findings(with("version=\"1.0\"", "version=\"2.0\"")), HasSubstr("room.xml:1:8: error[E765]"));
  const std::string wall = kRoom.substr(kRoom.find("  <wall"), kRoom.find("</walls>") - kRoom.find("  <wall"));
  EXPECT_THAT(findings(with("</walls>", wall + "</walls>")), HasSubstr("room.xml:4:3: error[E763]"));
  Diagnostics diagnostics;
  const Walls walls = parseWalls(kRoom, "room.xml", diagnostics);
  try {
    walls.wall("frnt");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("E764"), HasSubstr("did you mean 'front'")));
  }
}

}  // namespace
}  // namespace presa::walls
