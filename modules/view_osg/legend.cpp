#include "modules/view_osg/legend.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "modules/view_osg/contact_glyphs.h"
#include "modules/view_osg/hud_widgets.h"
#include "modules/view_osg/ink.h"

namespace presa::view {
namespace {

constexpr float kLegendRow = 37, kLetters = 23, kMarks = 66;
constexpr int kRows = 5;

}  // namespace

void addLegend(osg::Group& right, float bottom, const Ink& ink) {
  const float left = -kMargin - kSideWidth, height = kRows * kLegendRow + 2 * 6;
  right.addChild(roundedPanel({left, bottom, kSideWidth, height}, 8, ink.panel));
  const float mark = left + kSideInset + 22;  // middle of the marks
  float y = bottom + height - 6 - kLegendRow / 2;
  const auto words = [&](float x, const char* text) {
    Label(right, x, y - 0.34F * kLetters, kLetters, ink.text).set(text);
  };
  const auto row = [&](const char* text) {
    words(left + kMarks, text);
    y -= kLegendRow;
  };

  right.addChild(dot(mark, y, 7, displayed(kHipColor)));
  row("HIP, as measured");
  right.addChild(dot(mark, y, 14, displayed(kSkinColor)));
  row("fingertip, at the surface");

  const osg::Vec4 arrow = displayed(kArrowColor);
  right.addChild(
      polygon({{mark - 20, y - 2.5F}, {mark + 6, y - 2.5F}, {mark + 6, y + 2.5F}, {mark - 20, y + 2.5F}}, arrow));
  right.addChild(polygon({{mark + 4, y - 9}, {mark + 22, y}, {mark + 4, y + 9}}, arrow));
  std::array<char, 48> scale{};
  std::snprintf(scale.data(), scale.size(), "force, %.0f mm per newton", 1000 * kArrowLengthPerNewton);
  row(scale.data());

  right.addChild(polygon({{mark, y - 13}, {mark + 14, y + 12}, {mark - 14, y + 12}},
                         displayed(stateColor(ContactMode::kStick), 0.9F)));
  row("cone of static friction");

  float x = mark;
  const auto state = [&](ContactMode mode, const char* text, float next) {
    right.addChild(dot(x, y, 9, displayed(stateColor(mode))));
    words(x + 16, text);
    x += next;
  };
  state(ContactMode::kStick, "sticks", 118);
  state(ContactMode::kSlip, "slips", 103);
  state(ContactMode::kNone, "free", 0);
}

}  // namespace presa::view
