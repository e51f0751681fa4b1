#include "modules/view_osg/time_bar.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

namespace presa::view {
namespace {

constexpr float kBarHalfHeight = 360, kBarHalfWidth = 330, kBarThick = 9;
constexpr double kReach = 10;  ///< clickable margin above and below the bar [lines]
const osg::Vec4 kBarInk(0.95F, 0.96F, 0.98F, 1), kFilled(0.38F, 0.70F, 1.0F, 1);

std::string seconds(double time) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f s", time);
  return text.data();
}

}  // namespace

void TimeBar::offer(const TimeControl& time_control, double length, bool drawn) {
  time_control_ = &time_control;
  length_ = length;
  if (!drawn) return;
  pace_.emplace(center_, 0, bottom_ + 18, 14, kBarInk, Typeface::kBold, Label::Align::kCenter);
  if (length <= 0) return;
  bar_.emplace(center_, Rect{-kBarHalfWidth, bottom_, 2 * kBarHalfWidth, kBarThick});
  now_.emplace(center_, -kBarHalfWidth, bottom_ + 18, 14, kBarInk, Typeface::kRegular, Label::Align::kLeft);
  end_.emplace(center_, kBarHalfWidth, bottom_ + 18, 14, kBarInk, Typeface::kRegular, Label::Align::kRight);
  end_->set(seconds(length));
}

void TimeBar::update(double time) {
  time_ = time;
  if (!pace_) return;
  if (bar_) {
    bar_->set(time / length_, kFilled);
    now_->set(seconds(time));
  }
  std::array<char, 64> text{};
  if (time_control_->paused)
    std::snprintf(text.data(), text.size(), "held");
  else if (const double speed = time_control_->speed; speed != 1)
    std::snprintf(text.data(), text.size(), "%.4g times real time", speed);
  pace_->set(text.data());
}

std::optional<double> TimeBar::momentAt(double right, double up, bool wherever_up) const {
  if (!bar_) return std::nullopt;
  const double x = right * kBarHalfHeight / kBarHalfWidth, y = up * kBarHalfHeight - (bottom_ + kBarThick / 2);
  if (!wherever_up && (std::abs(x) > 1 || std::abs(y) > kReach)) return std::nullopt;
  return length_ * std::clamp((x + 1) / 2, 0.0, 1.0);
}

}  // namespace presa::view
