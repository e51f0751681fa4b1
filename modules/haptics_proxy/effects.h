#pragma once
#include <string>
#include <vector>

#include "framework/core/graph/module.h"
#include "framework/scene/run_options.h"
#include "framework/scene/world.h"

namespace presa {

/// The effects that a scene uses; they determine the stages of the haptic tick.
struct HapticEffects {
  enum class Poses { kNone, kInterpolate, kHold };  ///< kNone: no touchable body moves
  Poses poses = Poses::kNone;
  std::string renderer;
  bool proxy = true;  ///< the renderer has a proxy that friction can hold
  bool friction = false;
  bool surface_change = false;   ///< friction that changes during the run
  bool commanded = false;        ///< surface parameters open to commands
  bool surface_effects = false;  ///< force shading and those of plug-ins
  bool hits = false;             ///< a surface effect hears bodies that hit each other
  bool damping = false;
  bool torsion = false;  ///< torsional friction of oriented tools
  bool held = false;     ///< the haptic thread moves what fingers hold
  bool impulse = false;  ///< summed for dynamics with averaged coupling
};

/// The effects that the scene uses: only those that some touchable body needs.
HapticEffects effectsOf(const World& world, const RunOptions& options);
/// The effects that the scene does not use, with the reasons, for `presa explain`.
std::vector<LeftOut> effectsLeftOut(const HapticEffects& effects);

}  // namespace presa
