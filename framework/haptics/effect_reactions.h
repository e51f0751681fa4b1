#pragma once
#include <cstdint>
#include <vector>

#include "framework/core/math/spatial.h"
#include "framework/core/state/limits.h"

namespace presa {

/// What force effects have given to moving bodies since the start. Impulses are summed up, so that the dynamics misses
/// none, however many haptic ticks lie between two of its steps: it applies the difference to its last step.
/// Written by: haptic thread.
struct EffectReactions {
  /// Reaction on one body.
  struct OnBody {
    std::int32_t body = kNoBody;            ///< index into Scene::bodies
    Vec3 impulse_W = Vec3::Zero();          ///< [N s]
    Vec3 angular_impulse_W = Vec3::Zero();  ///< about the origin of the body's frame [N m s]
  };
  std::vector<OnBody> bodies;  ///< one for each moving body that some force effect acts on

  /// Memory outside the struct itself (SizedAtLoad).
  std::size_t roomBytes() const noexcept { return bodies.capacity() * sizeof(OnBody); }
};

/// ForceEffects writes it; the dynamics reads it.
inline constexpr const char* kEffectReactionsPort = "effect_reactions";

}  // namespace presa
