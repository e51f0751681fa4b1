#pragma once
#include <string>
#include <vector>

#include "framework/core/graph/module.h"
#include "framework/scene/world.h"

namespace presa {

/// Which stages the haptic tick has.
struct HapticEffects {
  enum class Poses { kNone, kInterpolate, kHold };  ///< kNone: nothing moves
  Poses poses = Poses::kNone;
  HapticSettings::Renderer renderer = HapticSettings::Renderer::kGodObject;
  bool friction = false;
  bool surface_change = false;  ///< friction that can change during a run
  bool commanded = false;       ///< stiffness and friction that commands can set
  bool shading = false;
  bool damping = false;
};

/// What the scene calls for: an effect that nothing touchable names is not among it.
HapticEffects effectsOf(const World& world);
/// What is not among it, and why.
std::vector<LeftOut> effectsLeftOut(const HapticEffects& effects);

}  // namespace presa
