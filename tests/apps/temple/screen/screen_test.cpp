// What a visitor reads: words that everybody knows, in the visitor's language. And what a visitor is shown.
#include <gtest/gtest.h>

#include <osg/NodeVisitor>
#include <osgText/Text>
#include <regex>

#include "apps/common/scratch_folder.h"
#include "apps/temple/building/words.h"
#include "framework/device/output_stage.h"
#include "modules/view_osg/picture.h"
#include "tests/apps/temple/visitor/first_task.h"

namespace presa::view {
namespace {

/// Texts that are drawn, those of hidden groups left out.
class ReadTexts final : public osg::NodeVisitor {
 public:
  ReadTexts() : osg::NodeVisitor(TRAVERSE_ACTIVE_CHILDREN) {}
  void apply(osg::Node& node) override {
    if (node.getNodeMask() != 0) traverse(node);
  }
  void apply(osg::Drawable& drawable) override {
    const auto* text = dynamic_cast<const osgText::Text*>(&drawable);
    if (text == nullptr || drawable.getNodeMask() == 0) return;
    std::string utf8 = text->getText().createUTF8EncodedString();
    if (!utf8.empty()) texts.push_back(std::move(utf8));
  }
  std::vector<std::string> texts;
};

class VisitScreen : public testing::TestWithParam<std::string> {
 protected:
  VisitScreen() : world(temple::test::loadFirstTask(1, scratch.path().string(), {}, GetParam()).world) {
    picture.emplace(world, RunOptions{.view = RunOptions::View::kWindow});
    picture->hud().setHelp(picture->visitorHelp());
    for (const Body& body : world->scene.bodies) frame.X_WB.push_back(body.X_WB);
    frame.asleep.resize(frame.X_WB.size());
    frame.device = DeviceState(2);
    frame.contacts = ContactExchange(2);
    frame.forces = ForceCommand(2);
    frame.forces.status = kOutputFading;
    frame.guidance = Guidance{};
    frame.guidance->all = 3;
    for (std::size_t f = 0; f < 2; ++f) {
      frame.device.fingers[f].valid = true;
      frame.device.fingers[f].p_WH = Vec3(f == 0 ? -0.05 : 0.05, 0, 0.15);
      frame.contacts.fingers[f].p_WH = frame.contacts.fingers[f].p_WP = frame.device.fingers[f].p_WH;
    }
  }
  std::vector<std::string> read() {
    picture->show(frame, {});
    ReadTexts reader;
    picture->root()->accept(reader);
    return reader.texts;
  }
  bool shows(const std::string& text) {
    const std::vector<std::string> all = read();
    return std::ranges::find(all, text) != all.end();
  }
  const AssemblyWords::Action& action(const std::string& name) const {
    return *std::ranges::find(world->scene.assembly->words.actions, name, &AssemblyWords::Action::name);
  }

  ScratchFolder scratch;
  std::shared_ptr<const World> world;
  std::optional<Picture> picture;
  ViewFrame frame;
};

// Names of files and scenes, symbols, units, states of the output stage, terms of the trade.
TEST_P(VisitScreen, HasNoJargon) {
  static const std::regex kJargon(R"(_|=|\b(HIP|proxy|fingertip|friction|cone|stick|slip|normal|tang|rate|tick|Hz)\b|)"
                                  R"(\b(output|fading|rig|haptic|body|N)\b)",
                                  std::regex::icase);
  for (int state = 0; state < 4; ++state) {
    if (state == 1) frame.guidance->hint_goal = 0, frame.guidance->hint_body = 0;
    if (state == 2) frame.guidance->body = 0, frame.guidance->held = true, frame.guidance->goal = 0;
    if (state == 3) picture->hud().toggleHelp();
    const std::vector<std::string> texts = read();
    EXPECT_GE(texts.size(), 2U);
    for (const std::string& text : texts)
      EXPECT_FALSE(std::regex_search(text, kJargon)) << text << " (state " << state << ")";
  }
}

// The help holds all actions, in the visitor's language, and nothing of another.
TEST_P(VisitScreen, HasItsHelpInItsLanguage) {
  EXPECT_FALSE(shows(action("undo").does));
  picture->hud().toggleHelp();
  for (const AssemblyWords::Action& one : world->scene.assembly->words.actions) {
    EXPECT_TRUE(shows(one.keys)) << one.name;
    EXPECT_TRUE(shows(one.does)) << one.name;
  }
  Diagnostics diagnostics;
  for (const std::string& other : temple::shippedLanguages()) {
    if (other == GetParam()) continue;
    for (const AssemblyWords::Action& one : temple::shippedWords(other, diagnostics).actions)
      EXPECT_EQ(shows(one.does), one.does == action(one.name).does) << one.does;
  }
}

// Each movement is shown until it was done, and nothing after the first block.
TEST_P(VisitScreen, ShowsHowUntilItWasDone) {
  const auto move = [&](const Vec3& by) {
    for (FingerInput& finger : frame.device.fingers) finger.p_WH += by;
    for (FingerContact& contact : frame.contacts.fingers) {
      contact.p_WH += by;
      contact.p_WP += by;
    }
  };
  EXPECT_TRUE(shows(action("drag").does));
  move({0.9 * Lesson::kDragged, 0, 0});
  EXPECT_TRUE(shows(action("drag").does));
  move({0.2 * Lesson::kDragged, 0, 0});
  read();
  EXPECT_TRUE(shows(action("pinch").does));
  EXPECT_FALSE(shows(action("drag").does));
  for (FingerContact& contact : frame.contacts.fingers) {
    contact.mode = ContactMode::kStick;
    contact.body = 0;
  }
  read();
  EXPECT_TRUE(shows(action("lift").does));
  move({0, 0, 1.1 * Lesson::kLifted});
  read();
  EXPECT_TRUE(shows(action("turn").does));
  frame.guidance->placed = 1;
  for (const char* name : {"drag", "pinch", "lift", "turn"}) EXPECT_FALSE(shows(action(name).does)) << name;
}

INSTANTIATE_TEST_SUITE_P(Languages, VisitScreen, testing::ValuesIn(temple::shippedLanguages()));

// Under a fingertip over the ground lies the ground; over a block, the block's upper face. The glow is on the nearest
// face, at the distance of a plane.
TEST(VisitSurroundings, LineAndGlowAreWhereTheSurfacesAre) {
  const ScratchFolder scratch;
  const auto world = temple::test::loadFirstTask(1, scratch.path().string(), {}).world;
  const Surroundings around(*world);
  std::vector<Pose> X_WB;
  std::size_t capital = 0;
  for (std::size_t i = 0; i < world->scene.bodies.size(); ++i) {
    X_WB.push_back(world->scene.bodies[i].X_WB);
    if (world->scene.bodies[i].name == "capital") capital = i;
  }
  EXPECT_NEAR(around.below({0.25, -0.2, 0.1}, X_WB).value(), 0, 1e-6);
  // the capital is one module, 24 mm, high and stands on the ground; its dowel hole is 0.3 modules wide to either side
  const Vec3 beside = X_WB[capital] * Vec3(0.016, 0.004, 0);
  EXPECT_NEAR(around.below({beside.x(), beside.y(), 0.1}, X_WB).value(), 0.024, 1e-5);
  const auto near = around.nearest({beside.x(), beside.y(), 0.024 + 0.03}, 0.05, X_WB);
  ASSERT_TRUE(near);
  EXPECT_NEAR(near->distance, 0.03, 1e-5);
  EXPECT_NEAR(near->nhat_W.z(), 1, 1e-6);
  EXPECT_FALSE(around.nearest({beside.x(), beside.y(), 0.024 + 0.06}, 0.05, X_WB));
}

}  // namespace
}  // namespace presa::view
