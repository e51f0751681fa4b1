#include "modules/view_osg/legend.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "modules/view_osg/contact_glyphs.h"
#include "modules/view_osg/hud_widgets.h"

namespace presa::view {
namespace {

constexpr float kMargin = 18, kWidth = 372, kRow = 37, kLetters = 23, kInset = 14, kMarks = 66;
constexpr int kRows = 5;

osg::Vec4 displayed(const Vec3& linear, float alpha = 1) {
  const auto code = [](double c) { return static_cast<float>(std::pow(std::min(1.0, c), 1 / 2.2)); };
  return {code(linear.x()), code(linear.y()), code(linear.z()), alpha};
}

}  // namespace

void addLegend(osg::Group& right, float bottom, const Ink& ink) {
  const float left = -kMargin - kWidth, height = kRows * kRow + 2 * 6;
  right.addChild(roundedPanel({left, bottom, kWidth, height}, 8, ink.panel));
  const float mark = left + kInset + 22;  // middle of the marks
  float y = bottom + height - 6 - kRow / 2;
  const auto words = [&](float x, const char* text) {
    Label(right, x, y - 0.34F * kLetters, kLetters, ink.text).set(text);
  };
  const auto row = [&](const char* text) {
    words(left + kMarks, text);
    y -= kRow;
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
