#include "tests/apps/temple/visitor/mouse_hand.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "framework/device/minimum_jerk.h"

namespace presa::temple::test {
namespace {

constexpr double kPixel = 2.0 / 720;                    // in halves of the picture's height
constexpr double kFittsStart = 0.25, kFittsBit = 0.13;  // duration of a movement: start + bit * log2(2 D / W) [s]
constexpr double kWidth = 0.015;                        // W: what a person takes for "there" [m]
constexpr double kNotch = 0.09, kKey = 0.2;             // between two notches, two keys [s]
constexpr double kFlattest = 0.3;                       // as in pointer_control.cpp

}  // namespace

HandTraits drawHand(RandomStream& random) {
  return {.overshoot = random.uniform(0.02, 0.15),
          .scatter = random.uniform(0.05, 0.15),
          .tremor = random.uniform(0.0005, 0.002),
          .tremor_hz = random.uniform(8, 12)};
}

void MouseHand::drag(const Vec3& way, bool upright, const view::PointerControl& pointer,
                     const view::CameraControl& camera) {
  const double scale = camera.scaleAt(pointer.state().p_WT);
  const Vec3 right = camera.axes().right, away = Vec3::UnitZ().cross(right);
  const double slope = upright ? std::cos(camera.elevation()) : std::sin(camera.elevation());
  const double far = 1 + traits_.overshoot + traits_.scatter * random_.normal();
  wanted_ = {far * way.dot(right) / scale,
             far * (upright ? way.z() : way.dot(away)) * std::max(kFlattest, slope) / scale};
  sent_ = {};
  upright_ = upright;
  shake_ = traits_.tremor / scale;
  lasts_ = left_ = kFittsStart + kFittsBit * std::max(0.0, std::log2(2 * way.norm() / kWidth));
}

void MouseHand::scroll(int notches) {
  notches_ = notches;
  next_ = clock_ + kNotch;
}

void MouseHand::turn(int keys) {
  keys_ = keys;
  next_ = clock_ + kKey;
}

void MouseHand::step(double period, view::PointerControl& pointer, const view::CameraControl& camera) {
  clock_ += period;
  if (left_ > 0) {
    left_ = std::max(0.0, left_ - period);
    const double part = minimumJerk(1 - left_ / lasts_);
    const double phase = 2 * std::numbers::pi * traits_.tremor_hz * clock_;
    const std::array<double, 2> shake{shake_ * std::sin(phase), shake_ * std::cos(1.3 * phase)};
    std::array<double, 2> by{};
    for (std::size_t i = 0; i < 2; ++i) {
      const double pixels = std::round((part * wanted_[i] + shake[i]) / kPixel) * kPixel;
      by[i] = pixels - sent_[i];
      sent_[i] = pixels;
    }
    if (upright_)
      pointer.dragUpright(by[0], by[1], camera);
    else
      pointer.dragLevel(by[0], by[1], camera);
  }
  if (clock_ < next_) return;
  if (notches_ != 0) {
    const int sign = notches_ > 0 ? 1 : -1;
    pointer.close(sign);
    notches_ -= sign;
    next_ = clock_ + kNotch * random_.uniform(0.7, 1.6);
  } else if (keys_ != 0) {
    const int sign = keys_ > 0 ? 1 : -1;
    pointer.turn(sign * view::PointerControl::kTurnStep);
    keys_ -= sign;
    next_ = clock_ + kKey * random_.uniform(0.7, 1.6);
  }
}

}  // namespace presa::temple::test
