// A participant's picture: nothing that is measured, and what the experiment lets them see.
#include <gtest/gtest.h>

#include <cstdlib>

#include "modules/view_osg/participant_panel.h"
#include "tests/modules/view_osg/png_picture.h"

namespace presa::view_test {
namespace {

class Participant : public testing::Test {
 protected:
  void SetUp() override { unsetenv("DISPLAY"); }

  /// The picture of these states; `screen` null: an operator's.
  static PngPicture draw(const std::string& name, const PinchStates& states, const ParticipantScreen* screen) {
    const std::string file = tempFile("participant_" + name + ".png");
    PinchRun run = makePinchRun(RunOptions::View::kOffscreen, file);
    if (screen != nullptr) run.options.participant = ParticipantScreen{};
    EXPECT_EQ(drawOnce(run, states, screen).outcome, View::Screenshot::Outcome::kWritten);
    return PngPicture(file);
  }
  static PinchStates states() { return makePinchStates(*makePinchRun({}, "").world, {0, 0, 0.08}); }

  /// The same place, felt otherwise: three times the force, both fingers slip, friction halved, the devices deeper, and a
  /// device at its limit.
  static PinchStates feltOtherwise() {
    PinchStates other = states();
    for (std::size_t f = 0; f < 2; ++f) {
      FingerContact& contact = other.contacts.fingers[f];
      contact.mode = ContactMode::kSlip;
      contact.normal_force *= 3;
      contact.tangential_force_W *= 3;
      contact.f_H_W *= 3;
      contact.friction_static = contact.friction_dynamic = 0.4;
      contact.p_WH = other.device.fingers[f].p_WH = contact.p_WP - contact.f_H_W / contact.stiffness;
      contact.depth *= 3;
      other.forces.f_H_W[f] = contact.f_H_W;
    }
    other.forces.status = 1;
    return other;
  }
};

int differing(const PngPicture& a, const PngPicture& b) {
  int count = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      const Color p = a.at(x, y), q = b.at(x, y);
      count += p.r != q.r || p.g != q.g || p.b != q.b ? 1 : 0;
    }
  }
  return count;
}

int bright(const PngPicture& picture, int top, int bottom) {
  int count = 0;
  for (int y = top; y < bottom; ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const Color c = picture.at(x, y);
      count += c.r > 200 && c.g > 200 && c.b > 200 ? 1 : 0;
    }
  }
  return count;
}

TEST_F(Participant, WhatFingersFeelChangesNoPixel) {
  const ParticipantScreen screen{.text = "Hold it still with the least grip you think necessary."};
  EXPECT_EQ(differing(draw("a", states(), &screen), draw("b", feltOtherwise(), &screen)), 0);
  EXPECT_GT(differing(draw("c", states(), nullptr), draw("d", feltOtherwise(), nullptr)), 1000);
  const ParticipantScreen measured{.measured = true};
  EXPECT_GT(differing(draw("e", states(), &measured), draw("f", feltOtherwise(), &measured)), 1000);
}

TEST_F(Participant, SeesBodiesFingertipsAndTheInstruction) {
  const ParticipantScreen all{.text = "Open slowly until it drops."}, silent{}, no_tips{.fingertips = false};
  const PngPicture with_text = draw("text", states(), &all), without = draw("silent", states(), &silent);
  EXPECT_GT(bright(with_text, 620, 700), bright(without, 620, 700) + 500);  // ink near the lower edge
  EXPECT_EQ(bright(without, 10, 90), bright(with_text, 10, 90));            // no title, no cards
  const Color middle = without.at(640, 360);
  EXPECT_GT(middle.r, 3 * middle.g / 2) << "the cube is red";
  EXPECT_GT(differing(without, draw("no_tips", states(), &no_tips)), 200);
}

TEST_F(Participant, SeesBlackAndACross) {
  const ParticipantScreen black{.bodies = false, .fingertips = false};
  const PngPicture dark = draw("black", states(), &black);
  for (int y = 0; y < dark.height(); y += 3) {
    for (int x = 0; x < dark.width(); x += 3) {
      const Color c = dark.at(x, y);
      ASSERT_EQ(c.r + c.g + c.b, 0) << x << ' ' << y;
    }
  }
  const ParticipantScreen cross{.bodies = false, .fingertips = false, .fixation = true};
  const PngPicture marked = draw("cross", states(), &cross);
  EXPECT_GT(marked.at(640, 360).g, 200);
  EXPECT_EQ(bright(marked, 0, 300) + bright(marked, 420, 720), 0);
}

TEST(WrappedText, BreaksBetweenWords) {
  using Lines = std::vector<std::string>;
  EXPECT_EQ(view::wrapped("", 10), Lines{});
  EXPECT_EQ(view::wrapped("one two three", 7), (Lines{"one two", "three"}));
  EXPECT_EQ(view::wrapped("incomprehensibilities are long", 7), (Lines{"incomprehensibilities", "are", "long"}));
  EXPECT_EQ(view::wrapped("finch\xc3\xa9 cade gi\xc3\xb9", 11), (Lines{"finch\xc3\xa9 cade", "gi\xc3\xb9"}));
  EXPECT_EQ(view::wrapped("which one\n1 or 2", 20), (Lines{"which one", "1 or 2"}));
}

}  // namespace
}  // namespace presa::view_test
