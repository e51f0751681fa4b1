#include "modules/view_osg/time_bar.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace presa::view {
namespace {

constexpr float kHalfHeight = 360, kHalfWidth = 330, kThick = 9;
constexpr double kReach = 10;  ///< clickable margin above and below the bar [lines]
const osg::Vec4 kInk(0.95F, 0.96F, 0.98F, 1), kFilled(0.38F, 0.70F, 1.0F, 1);

}  // namespace

void TimeBar::offer(const TimeControl& time_control, double length) {
  time_control_ = &time_control;
  length_ = length;
  pace_.emplace(center_, 0, bottom_ + 18, 14, kInk, Typeface::kBold, Label::Align::kCenter);
  if (length > 0) bar_.emplace(center_, Rect{-kHalfWidth, bottom_, 2 * kHalfWidth, kThick});
}

void TimeBar::update(double time) {
  time_ = time;
  if (time_control_ == nullptr) return;
  if (bar_) bar_->set(time / length_, kFilled);
  std::array<char, 64> text{};
  if (time_control_->paused)
    std::snprintf(text.data(), text.size(), "held");
  else if (const double speed = time_control_->speed; speed != 1)
    std::snprintf(text.data(), text.size(), "%.4g times real time", speed);
  pace_->set(text.data());
}

std::optional<double> TimeBar::momentAt(double right, double up, bool wherever_up) const {
  if (!bar_) return std::nullopt;
  const double x = right * kHalfHeight / kHalfWidth, y = up * kHalfHeight - (bottom_ + kThick / 2);
  if (!wherever_up && (std::abs(x) > 1 || std::abs(y) > kReach)) return std::nullopt;
  return length_ * std::clamp((x + 1) / 2, 0.0, 1.0);
}

}  // namespace presa::view
