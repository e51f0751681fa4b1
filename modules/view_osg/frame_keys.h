#pragma once
#include <array>

#include "framework/device/pointer_state.h"

namespace presa::view {

/// Keys of the window that move the frames of a rig while they are held: Alt with arrows and page keys walks, turns and
/// flies; v is the clutch; z and x zoom to the larger and to the smaller scale.
class FrameKeys {
 public:
  /// True if the key belongs to the frames. A release counts with and without Alt.
  bool take(int key, bool down, bool alt);
  /// What the held keys mean together.
  FrameWish wish() const;

 private:
  enum Held { kAhead, kBack, kLeft, kRight, kUp, kDown, kClutch, kCoarser, kFiner, kCount };
  double share(Held one, Held other) const { return (held_[one] ? 1.0 : 0.0) - (held_[other] ? 1.0 : 0.0); }
  std::array<bool, kCount> held_{};
};

}  // namespace presa::view
