#pragma once
#include <cstdint>

#include "framework/device/device.h"

namespace presa::python {

/// A fingertip that the caller moves between steps: it goes to its target in a straight line at constant speed. The
/// force does not push it; who wants a hand that yields reads the force and moves the target. Thread: the caller's.
class MovedFinger final : public Device {
 public:
  /// `p_WH`: where it starts [m].
  explicit MovedFinger(const Vec3& p_WH) : p_WH_(p_WH), target_(p_WH) {}

  /// Is at `p_WH` [m] in the tick that is the `ticks`-th from now, and stays there.
  void goTo(const Vec3& p_WH, std::uint64_t ticks) noexcept {
    target_ = p_WH;
    left_ = ticks;
    step_ = (target_ - p_WH_) / static_cast<double>(ticks);
  }
  /// Bits of FingerInput::buttons.
  void press(std::uint32_t buttons) noexcept { buttons_ = buttons; }

  FingerInput read(const Tick& tick) noexcept override {
    FingerInput input;
    if (left_ > 0) {
      p_WH_ = --left_ == 0 ? target_ : Vec3(p_WH_ + step_);
      input.v_WH = step_ / tick.period;
    }
    input.p_WH = p_WH_;
    input.buttons = buttons_;
    input.valid = true;
    return input;
  }
  void write(const Wrench& /*F_H_W*/, const Tick& /*tick*/) noexcept override {}
  int buttons() const override { return 32; }
  std::string model() const override { return "a finger that a Python program moves: a model, not a person"; }

 private:
  Vec3 p_WH_, target_;
  Vec3 step_ = Vec3::Zero();  // [m] per tick
  std::uint64_t left_ = 0;    // ticks until the target
  std::uint32_t buttons_ = 0;
};

}  // namespace presa::python
