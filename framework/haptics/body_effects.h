#pragma once
#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/haptics/body_effect.h"
#include "framework/scene/world.h"

namespace presa {

/// The body effects of a scene that act on free bodies, and who broke the contract. Thread: the owner's, except for
/// construction, names and brokenName.
class BodyEffects {
 public:
  /// Loads the plug-ins of the scene's elements. Throws InputError: the errors of pluginTable; E596 an effect that
  /// cannot be made.
  explicit BodyEffects(const World& world);

  std::size_t size() const noexcept { return effects_.size(); }  ///< number of effects that act on free bodies
  /// kNoBody: the effect acts on every free body.
  std::int32_t bodyOf(std::size_t effect) const noexcept { return effects_[effect].body; }
  /// The wrench of that effect on one body. Zero from then on after any effect broke its contract.
  BodyEffectWrench apply(std::size_t effect, const BodyEffectInput& input) noexcept;

  /// "<drag> of body 'cube'", in the order of the scene.
  std::vector<std::string> names() const;
  /// Any thread: an effect broke its contract; all are off for the rest of the run.
  bool broken() const noexcept { return broken_.load(std::memory_order_acquire) >= 0; }
  /// Any thread: "body effect <drag> of body 'cube'", the first that broke its contract, or none.
  std::optional<std::string> brokenName() const;

 private:
  struct Effect {
    std::unique_ptr<BodyEffect> effect;
    std::string name;
    double max_force = 0, max_torque = 0;  ///< [N], [N m]
    std::int32_t body = kNoBody;           ///< kNoBody: every free body
  };

  std::vector<Effect> effects_;
  std::atomic<int> broken_{-1};
};

/// Whether an element acts on a free body.
bool actsOnFreeBody(const Scene& scene, const PluginElement& element);
/// Whether the scene has a body effect that acts on a free body.
bool hasBodyEffects(const Scene& scene);

}  // namespace presa
