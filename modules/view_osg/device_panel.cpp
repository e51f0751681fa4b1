#include "modules/view_osg/device_panel.h"
#include "modules/view_osg/hud_widgets.h"
#include "modules/view_osg/ink.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace presa::view {
namespace {

constexpr float kHead = 54, kRow = 34, kColumn = 76, kGap = 14, kFoot = 8;
constexpr double kFullBar = 1e-3;  ///< deflection of a full bar [m]
const osg::Vec4 kLineBar(0.98F, 0.35F, 0.77F, 1);

float rightOf(std::size_t column, std::size_t columns) {
  return -kMargin - kSideInset - static_cast<float>(columns - 1 - column) * (kColumn + kGap);
}

}  // namespace

DevicePanel::DevicePanel(osg::Group& right, Of what, const std::vector<DeviceFigures::Told>& devices, const Ink& ink)
    : what_(what) {
  std::vector<std::string> columns{"along", "across"};
  std::array<char, 64> note{};
  std::snprintf(note.data(), note.size(), "drawn %.0f times as large", kDeflectionScale);
  if (what == Of::kHeat) {
    columns.clear();
    for (const auto& device : devices)
      if (device.motors.size() > columns.size()) columns = device.motors;
    std::snprintf(note.data(), note.size(), "estimated from the forces");
  }
  right.addChild(group_);
  height_ = kHead + kRow * static_cast<float>(devices.size()) + kFoot;
  const float left = -kMargin - kSideWidth;
  group_->addChild(roundedPanel({left, -height_, kSideWidth, height_}, 8, ink.panel));
  Label(*group_, left + kSideInset, -22, 16, ink.text, Typeface::kBold)
      .set(what == Of::kHeat ? "motor heat [%]" : "deflection [mm]");
  Label(*group_, -kMargin - kSideInset, -22, 13, ink.soft, Typeface::kRegular, Label::Align::kRight).set(note.data());
  for (std::size_t i = 0; i < columns.size(); ++i)
    Label(*group_, rightOf(i, columns.size()), -44, 13, ink.soft, Typeface::kRegular, Label::Align::kRight)
        .set(columns[i]);
  for (std::size_t i = 0; i < devices.size(); ++i)
    addRow(devices[i].role, -kHead - kRow * static_cast<float>(i), columns.size(), ink);
}

void DevicePanel::addRow(const std::string& role, float top, std::size_t columns, const Ink& ink) {
  Label(*group_, -kMargin - kSideWidth + kSideInset, top - 16, 15, ink.text, Typeface::kBold).set(role);
  std::vector<Value> row;
  for (std::size_t i = 0; i < columns; ++i) {
    const float right = rightOf(i, columns);
    row.push_back({Label(*group_, right, top - 16, 15, ink.text, Typeface::kMono, Label::Align::kRight),
                   Bar(*group_, {right - kColumn, top - 25, kColumn, 4}, ink.track)});
  }
  rows_.push_back(std::move(row));
}

void DevicePanel::update(const std::vector<DeviceFigures::Told>& devices) {
  const auto set = [](Value& value, const char* format, double number, double share, const osg::Vec4& color) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), format, number);
    value.number.set(text.data());
    value.bar.set(std::clamp(share, 0.0, 1.0), color);
  };
  for (std::size_t i = 0; i < rows_.size() && i < devices.size(); ++i) {
    std::vector<Value>& row = rows_[i];
    const DeviceFigures::Told& told = devices[i];
    if (what_ == Of::kDeflection && told.deflection) {
      set(row[0], "%.2f", 1e3 * told.deflection->along, told.deflection->along / kFullBar, kLineBar);
      set(row[1], "%.2f", 1e3 * told.deflection->across, told.deflection->across / kFullBar, kLineBar);
      continue;
    }
    for (std::size_t m = 0; m < row.size(); ++m) {
      const bool known = what_ == Of::kHeat && told.heat && m < told.heat->size();
      if (known)
        set(row[m], "%.0f", 100 * (*told.heat)[m], (*told.heat)[m], displayed(heatColor((*told.heat)[m])));
      else
        set(row[m], "not known", 0, 0, {});
    }
  }
}

}  // namespace presa::view
