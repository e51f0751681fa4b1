#pragma once
#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/device_state.h"
#include "framework/haptics/effect_reactions.h"
#include "framework/haptics/force_effect.h"
#include "framework/haptics/touchables.h"
#include "framework/scene/world.h"

namespace presa {

/// The force effects of a scene. Adds their forces and torques to those of each tool, and sums up their reactions on
/// moving bodies. A plug-in whose force or couple is not finite or above its bound is broken: from then on every tool's
/// force is NaN, which the output stage latches as a fault and takes to zero.
/// Thread: haptic, except for construction and names.
class ForceEffects {
 public:
  /// Loads the plug-ins of the scene's elements. Throws InputError: the errors of pluginTable; E596 an effect that
  /// cannot be made.
  explicit ForceEffects(const World& world);

  /// The reactions, all zero, for the port that will hold them.
  EffectReactions reactions() const;
  /// Adds the forces of all effects on one tool to `out`, and their reactions over the tick to `reactions`, which must
  /// come from reactions(). NaN force after a broken contract.
  void apply(std::size_t tool, const Tick& tick, const FingerInput& input, double radius, const Touchables& touchables,
             FingerContact& out, EffectReactions& reactions) noexcept;

  /// "<magnet> of body 'cube'", in the order of the scene.
  std::vector<std::string> names() const;
  /// Any thread: index of the effect that broke its contract, or -1.
  int broken() const noexcept { return broken_.load(std::memory_order_acquire); }

 private:
  struct Effect {
    std::unique_ptr<ForceEffect> effect;
    std::string name;
    double max_force = 0, max_torque = 0;  ///< [N], [N m]
    std::int32_t body = kNoBody;
    std::int32_t slot = -1;  ///< index into EffectReactions::bodies; -1: the body does not move
  };
  void react(const Effect& effect, const EffectForce& force, const Pose& X_WB, bool oriented, double period,
             EffectReactions& reactions) const noexcept;

  std::vector<Effect> effects_;
  std::vector<std::int32_t> moving_;  ///< body of each slot
  std::atomic<int> broken_{-1};
};

}  // namespace presa
