#include "modules/view_osg/offset_panel.h"

#include <cmath>
#include <cstdio>

#include "modules/view_osg/contact_glyphs.h"
#include "modules/view_osg/hud_widgets.h"
#include "modules/view_osg/ink.h"

namespace presa::view {
namespace {

constexpr float kOffsetHead = 32, kFinger = 72, kOffsetRow = 25, kOffsetColumn = 96, kOffsetGap = 12;
constexpr float kRight = -kMargin - kSideInset;  // right end of the last column

FingerOffset split(const Vec3& offset, const Vec3& nhat) {
  const double normal = offset.dot(nhat);
  return {normal, (offset - normal * nhat).norm()};
}

}  // namespace

FingerOffset offsetFromHip(const FingerContact& contact, const Quat& R_WB) {
  return split(contact.p_WP - contact.p_WH, R_WB * contact.nhat_B);
}
FingerOffset offsetFromObject(const FingerContact& contact) { return split(contact.p_BP, contact.nhat_B); }

float OffsetPanel::heightFor(const World& world) {
  return kOffsetHead + kFinger * static_cast<float>(world.scene.devices.size()) + 24;
}

OffsetPanel::OffsetPanel(osg::Group& right, float top, const World& world, const Ink& ink) {
  right.addChild(group_);
  const std::size_t fingers = world.scene.devices.size();
  const float height = heightFor(world), left = -kMargin - kSideWidth;
  group_->addChild(roundedPanel({left, top - height, kSideWidth, height}, 8, ink.panel));
  Label(*group_, left + kSideInset, top - 22, 16, ink.text, Typeface::kBold).set("offset [mm]");
  Label(*group_, kRight - kOffsetColumn - kOffsetGap, top - 22, 14, ink.soft, Typeface::kRegular, Label::Align::kRight)
      .set("tangential");
  Label(*group_, kRight, top - 22, 14, ink.soft, Typeface::kRegular, Label::Align::kRight).set("normal");
  for (std::size_t i = 0; i < fingers; ++i)
    addFinger(world.scene.devices[i].role, top - kOffsetHead - kFinger * static_cast<float>(i), ink);
  std::array<char, 64> scale{};
  std::snprintf(scale.data(), scale.size(), "full bars: %.0f mm, %.0f mm", 1e3 * kHipBar, 1e3 * kObjectBar);
  Label(*group_, kRight, top - height + 10, 12, ink.soft, Typeface::kRegular, Label::Align::kRight).set(scale.data());
}

void OffsetPanel::addFinger(const std::string& role, float top, const Ink& ink) {
  const float left = -kMargin - kSideWidth + kSideInset;
  Label(*group_, left, top - 16, 15, ink.text, Typeface::kBold).set(role);
  const auto value = [&](float y, float right, double full) {
    return Value{Label(*group_, right, y, 15, ink.text, Typeface::kMono, Label::Align::kRight),
                 Bar(*group_, {right - kOffsetColumn, y - 7, kOffsetColumn, 4}, ink.track), full};
  };
  const auto name = [&](float y, const char* text) { Label(*group_, left, y, 14, ink.soft).set(text); };
  const float hip = top - 16 - kOffsetRow + 6, object = hip - kOffsetRow - 2,
              first = kRight - kOffsetColumn - kOffsetGap;
  name(hip, "finger \xe2\x88\x92 HIP");
  name(object, "finger \xe2\x88\x92 object");
  fingers_.push_back({value(hip, first, kHipBar), value(hip, kRight, kHipBar), value(object, first, kObjectBar),
                      value(object, kRight, kObjectBar)});
}

void OffsetPanel::set(Value& value, bool touches, double offset, ContactMode mode) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3f", 1e3 * offset);
  value.number.set(touches ? text.data() : "\xe2\x80\x93");
  value.bar.set(touches ? std::abs(offset) / value.full : 0, displayed(stateColor(mode)));
}

void OffsetPanel::update(const ViewFrame& frame) {
  const std::vector<FingerContact>& contacts = frame.contacts.fingers;
  for (std::size_t i = 0; i < fingers_.size(); ++i) {
    const FingerContact contact = i < contacts.size() ? contacts[i] : FingerContact{};
    const auto body = static_cast<std::size_t>(contact.body);
    const bool touches = contact.mode != ContactMode::kNone && contact.body != kNoBody && body < frame.X_WB.size();
    const Quat R_WB = touches ? Quat(frame.X_WB[body].q) : Quat(Quat::Identity());
    const FingerOffset hip = offsetFromHip(contact, R_WB), object = offsetFromObject(contact);
    set(fingers_[i][0], touches, hip.tangential, contact.mode);
    set(fingers_[i][1], touches, hip.normal, contact.mode);
    set(fingers_[i][2], touches, object.tangential, contact.mode);
    set(fingers_[i][3], touches, object.normal, contact.mode);
  }
}

}  // namespace presa::view
