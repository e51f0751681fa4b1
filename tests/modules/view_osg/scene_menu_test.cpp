// The menu of scenes in a window: what its keys mark and choose.
#include "modules/view_osg/scene_menu.h"

#include <gtest/gtest.h>

#include <osgGA/GUIEventAdapter>

namespace presa::view {
namespace {

using Event = osgGA::GUIEventAdapter;

/// Two groups of 6 and 5 scenes.
std::vector<OfferedScene> elevenScenes() {
  std::vector<OfferedScene> scenes;
  for (int i = 0; i < 11; ++i)
    scenes.push_back({i < 6 ? "Contact" : "Grasp", "scene_" + std::to_string(i), "The sentence of a scene"});
  return scenes;
}

struct SceneMenuKeys : testing::Test {
  osg::ref_ptr<osg::Group> center = new osg::Group;
  SceneMenu menu{*center, Ink{}, elevenScenes(), 2};
};

TEST_F(SceneMenuKeys, BeginClosedAtTheSceneThatRuns) {
  EXPECT_FALSE(menu.open());
  EXPECT_EQ(menu.marked(), 2U);
  EXPECT_FALSE(menu.wish().has_value());
  menu.toggle();
  EXPECT_TRUE(menu.open());
  menu.key(Event::KEY_Escape);
  EXPECT_FALSE(menu.open());
}

TEST_F(SceneMenuKeys, GoUpAndDownThroughTheGroupsAndStopAtTheEnds) {
  for (int i = 0; i < 4; ++i) menu.key(Event::KEY_Down);
  EXPECT_EQ(menu.marked(), 6U) << "first of the second group";
  menu.key(Event::KEY_Up);
  EXPECT_EQ(menu.marked(), 5U);
  menu.key(Event::KEY_Home);
  menu.key(Event::KEY_Up);
  EXPECT_EQ(menu.marked(), 0U);
  menu.key(Event::KEY_End);
  menu.key(Event::KEY_Down);
  EXPECT_EQ(menu.marked(), 10U);
}

TEST_F(SceneMenuKeys, GoSidewaysToTheNextColumnAndBack) {
  menu.key(Event::KEY_Right);
  const std::size_t beside = menu.marked();
  EXPECT_GT(beside, 2U);
  menu.key(Event::KEY_Left);
  const std::size_t back = menu.marked();
  EXPECT_NEAR(static_cast<double>(back), 2, 1) << "headings shift the rows of the columns by half a row at most";
  menu.key(Event::KEY_Left);
  EXPECT_EQ(menu.marked(), back) << "there is no column on the left";
}

TEST_F(SceneMenuKeys, ChooseASceneToWatchOrForOnesOwnHand) {
  menu.key(Event::KEY_Down);
  menu.key(Event::KEY_Return);
  ASSERT_TRUE(menu.wish().has_value());
  EXPECT_EQ(menu.wish()->scene, 3U);
  EXPECT_FALSE(menu.wish()->by_hand);
  menu.key(Event::KEY_Space);
  EXPECT_TRUE(menu.wish()->by_hand);
}

}  // namespace
}  // namespace presa::view
