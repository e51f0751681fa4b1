#pragma once
#include "devices/novint_falcon/link.h"
#include "framework/core/state/device_state.h"

namespace presa::falcon {

/// Transforms a sample in frame D to a finger in the world. Buttons: bit 0 centre (ready, answer), 1 forward, 2 plus, 3
/// minus.
FingerInput fingerOf(const LinkSample& sample, const Pose& X_WD, double scale) noexcept;

}  // namespace presa::falcon
