#include "devices/novint_falcon/finger.h"

namespace presa::falcon {
namespace {

std::uint32_t fingerButtons(std::uint8_t buttons) noexcept {
  const auto bit = [buttons](Button button, unsigned to) { return (buttons & button) != 0 ? 1U << to : 0U; };
  return bit(kButtonCentre, 0) | bit(kButtonForward, 1) | bit(kButtonPlus, 2) | bit(kButtonMinus, 3);
}

}  // namespace

FingerInput fingerOf(const LinkSample& sample, const Pose& X_WD, double scale) noexcept {
  FingerInput finger;
  finger.p_WH = X_WD * Vec3(scale * sample.p_DH);
  finger.v_WH = X_WD.q * Vec3(scale * sample.v_DH);
  finger.valid = sample.valid;
  finger.lost = sample.lost;
  finger.buttons = fingerButtons(sample.buttons);
  return finger;
}

}  // namespace presa::falcon
